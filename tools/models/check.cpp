#include "check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace zskel::models {
namespace {

using Edge = std::pair<unsigned, unsigned>;

class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : leader_(count), sets_(count) {
        std::iota(leader_.begin(), leader_.end(), 0);
    }
    void join(std::size_t a, std::size_t b) {
        a = find(a);
        b = find(b);
        sets_ -= a == b ? 0 : 1;
        leader_[a] = b;
    }
    std::size_t find(std::size_t i) {
        while (leader_[i] != i) {
            i = leader_[i] = leader_[leader_[i]];
        }
        return i;
    }
    std::size_t count() const { return sets_; }

  private:
    std::vector<std::size_t> leader_;
    std::size_t sets_;
};

struct Topology {
    bool is_oriented = true;  ///< No directed edge is used twice.
    bool is_manifold = true;  ///< Every vertex has one fan of faces.
    std::size_t components = 0;
    std::size_t boundary_loops = 0;
    std::ptrdiff_t genus = 0;
};

Topology measure_topology(const Triangles& mesh) {
    Topology result;
    const std::size_t corners = 3 * mesh.faces.size();
    std::map<Edge, std::size_t> corner_of;  // directed edge -> the corner that it leaves from
    for (std::size_t c = 0; c < corners; ++c) {
        const glm::uvec3& f = mesh.faces[c / 3];
        const auto k = static_cast<int>(c % 3);
        result.is_oriented &= corner_of.try_emplace({f[k], f[(k + 1) % 3]}, c).second;
    }
    DisjointSets components(mesh.vertices.size()), fans(corners), loops(mesh.vertices.size());
    std::size_t edges = 0, boundary_vertices = 0;
    for (const auto& [edge, corner] : corner_of) {
        components.join(edge.first, edge.second);
        const auto twin = corner_of.find({edge.second, edge.first});
        if (twin == corner_of.end()) {
            loops.join(edge.first, edge.second);
            ++boundary_vertices;
            ++edges;
            continue;
        }
        const std::size_t next = 3 * (corner / 3) + (corner + 1) % 3;
        fans.join(next, twin->second);
        edges += edge.first < edge.second ? 1 : 0;
    }
    result.is_manifold = fans.count() == mesh.vertices.size();
    result.components = components.count();
    result.boundary_loops = boundary_vertices - (mesh.vertices.size() - loops.count());
    const auto euler = static_cast<std::ptrdiff_t>(mesh.vertices.size() + mesh.faces.size()) -
                       static_cast<std::ptrdiff_t>(edges);
    result.genus = static_cast<std::ptrdiff_t>(result.components) -
                   (euler + static_cast<std::ptrdiff_t>(result.boundary_loops)) / 2;
    return result;
}

double signed_volume(const Triangles& mesh) {
    double volume = 0.0;
    for (const glm::uvec3& f : mesh.faces) {
        volume += glm::dot(mesh.vertices[f.x], glm::cross(mesh.vertices[f.y], mesh.vertices[f.z]));
    }
    return volume / 6.0;
}

/// Least angle of any triangle, in degrees.
double least_angle_deg(const Triangles& mesh) {
    double least = 180.0;
    for (const glm::uvec3& f : mesh.faces) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 a = mesh.vertices[f[k]];
            const glm::dvec3 b = mesh.vertices[f[(k + 1) % 3]] - a;
            const glm::dvec3 c = mesh.vertices[f[(k + 2) % 3]] - a;
            least = std::min(
                least, glm::degrees(std::atan2(glm::length(glm::cross(b, c)), glm::dot(b, c))));
        }
    }
    return least;
}

std::size_t count_outside(const Model& model) {
    return static_cast<std::size_t>(std::count_if(
        model.truth.nodes.begin(), model.truth.nodes.end(),
        [&](const Truth::Node& n) { return winding_number(model.mesh, n.position) < 0.5; }));
}

/// True where a node is far enough from every junction for its radius to be a tube's.
std::vector<bool> find_tube_nodes(const Truth& truth) {
    std::vector<bool> is_tube(truth.nodes.size(), false);
    for (const TruthLimb& limb : truth.limbs) {
        for (const std::size_t node : limb.nodes) {
            is_tube[node] = limb.is_tube;
        }
    }
    const std::vector<std::size_t> degrees = count_degrees(truth);
    for (std::size_t j = 0; j < truth.nodes.size(); ++j) {
        for (std::size_t i = 0; degrees[j] > 2 && i < truth.nodes.size(); ++i) {
            const double away = glm::distance(truth.nodes[i].position, truth.nodes[j].position);
            if (away < 2.0 * truth.nodes[j].radius + truth.nodes[i].radius) {
                is_tube[i] = false;
            }
        }
    }
    return is_tube;
}

/// Largest |distance to the mesh / radius - 1| over the nodes inside tubes.
double largest_radius_error(const Model& model) {
    const std::vector<bool> is_tube = find_tube_nodes(model.truth);
    double largest = 0.0;
    for (std::size_t i = 0; i < model.truth.nodes.size(); ++i) {
        if (is_tube[i]) {
            const Truth::Node& node = model.truth.nodes[i];
            const double distance = distance_to_mesh(model.mesh, node.position);
            largest = std::max(largest, std::abs(distance / node.radius - 1.0));
        }
    }
    return largest;
}

}  // namespace

CheckResult check_model(const Model& model) {
    CheckResult result;
    const Expected& want = model.expected;
    const auto require = [&](bool holds, const std::string& failure) {
        if (!holds) {
            result.failures.push_back(model.name + ": " + failure);
        }
    };
    const auto require_count = [&](std::size_t measured, std::size_t wanted, const char* what) {
        require(measured == wanted, fmt::format("{} {}, expected {}", measured, what, wanted));
    };
    const Topology topology = measure_topology(model.mesh);
    const double volume = signed_volume(model.mesh);
    const double face_error = std::abs(
        static_cast<double>(model.mesh.faces.size()) / static_cast<double>(want.faces) - 1.0);
    const double radius_error = largest_radius_error(model);
    require(topology.is_oriented, "a directed edge is used twice");
    require(topology.is_manifold, "a vertex has more than one fan of faces");
    require(volume > 0.0, "oriented inward");
    require(face_error <= 0.05,
            fmt::format("{} faces, expected {}", model.mesh.faces.size(), want.faces));
    require_count(topology.components, 1, "components");
    require_count(topology.boundary_loops, want.boundary_loops, "boundary loops");
    require_count(static_cast<std::size_t>(topology.genus), want.genus, "handles");
    require_count(count_ends(model.truth), want.ends, "ends");
    require_count(count_cycles(model.truth), want.cycles, "cycles");
    require_count(count_outside(model), 0, "nodes of the truth outside");
    require(radius_error <= want.radius_tolerance,
            fmt::format("a radius is wrong by {:.3f} of itself, allowed {}", radius_error,
                        want.radius_tolerance));
    result.measured = fmt::format(
        "{:13} {:6} faces  genus {}  loops {}  volume {:.5f}  least angle {:4.1f} deg  "
        "{:5} nodes  {:3} ends  {} cycles  radius error {:.3f}",
        model.name, model.mesh.faces.size(), topology.genus, topology.boundary_loops, volume,
        least_angle_deg(model.mesh), model.truth.nodes.size(), count_ends(model.truth),
        count_cycles(model.truth), radius_error);
    return result;
}

}  // namespace zskel::models
