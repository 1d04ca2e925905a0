#include "primitives.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace zskel::models {
namespace {

/// The surface of the cube [-cells, cells]^3 in steps of 2, with shared vertices.
Triangles grid_cube(int cells) {
    Triangles mesh;
    std::map<std::tuple<int, int, int>, unsigned> known;
    const auto vertex = [&](const glm::ivec3& p) {
        const auto [entry, is_new] = known.try_emplace(std::tuple(p.x, p.y, p.z),
                                                       static_cast<unsigned>(mesh.vertices.size()));
        if (is_new) {
            mesh.vertices.emplace_back(p);
        }
        return entry->second;
    };
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2, sign = side % 2 == 0 ? 1 : -1;
        const auto at = [&](int i, int j) {
            glm::ivec3 p;
            p[axis] = sign * cells;
            p[(axis + 1) % 3] = sign * (2 * i - cells);
            p[(axis + 2) % 3] = 2 * j - cells;
            return vertex(p);
        };
        for (int i = 0; i < cells; ++i) {
            for (int j = 0; j < cells; ++j) {
                const unsigned a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                               d = at(i, j + 1);
                mesh.faces.emplace_back(a, b, c);
                mesh.faces.emplace_back(a, c, d);
            }
        }
    }
    return mesh;
}

/// The truth of a compact solid: one node.
Truth single_node(const std::string& name) {
    return {{{glm::dvec3(0.0), 0.5}}, {}, {{name, {0}, true}}};
}

/// Rings of points, each joined to the next.
void join_rings(Triangles& mesh, unsigned from, unsigned to, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        const unsigned j = (i + 1) % count;
        mesh.faces.emplace_back(from + i, from + j, to + j);
        mesh.faces.emplace_back(from + i, to + j, to + i);
    }
}

double turn(unsigned i, unsigned count) {
    return 2.0 * std::numbers::pi * i / count;
}

/// Rings around the x axis, closed by a fan to x = -pole and one to x = pole.
Triangles revolve(const std::vector<glm::dvec2>& profile, double pole, unsigned round) {
    Triangles mesh;
    for (const glm::dvec2& point : profile) {
        for (unsigned i = 0; i < round; ++i) {
            mesh.vertices.emplace_back(point.x, point.y * std::cos(turn(i, round)),
                                       point.y * std::sin(turn(i, round)));
        }
    }
    const auto count = static_cast<unsigned>(mesh.vertices.size());
    for (unsigned first = 0; first + round < count; first += round) {
        join_rings(mesh, first, first + round, round);
    }
    mesh.vertices.emplace_back(-pole, 0.0, 0.0);
    mesh.vertices.emplace_back(pole, 0.0, 0.0);
    for (unsigned i = 0; i < round; ++i) {
        const unsigned j = (i + 1) % round;
        mesh.faces.emplace_back(count, j, i);
        mesh.faces.emplace_back(count + 1, count - round + i, count - round + j);
    }
    return mesh;
}

}  // namespace

Model make_cube(const std::string& name, unsigned cells) {
    Triangles mesh = grid_cube(static_cast<int>(cells));
    for (glm::dvec3& v : mesh.vertices) {
        v /= 2.0 * cells;
    }
    return {name, std::move(mesh), single_node(name), {.faces = 12 * cells * cells}};
}

Model make_sphere() {
    constexpr unsigned kCells = 11;
    Triangles mesh = grid_cube(kCells);
    for (glm::dvec3& v : mesh.vertices) {
        const glm::dvec3 even = glm::tan(v / double{kCells} * (std::numbers::pi / 4.0));
        v = 0.5 * glm::normalize(even);
    }
    return {"sphere", std::move(mesh), single_node("sphere"), {.faces = 12 * kCells * kCells}};
}

Model make_capsule() {
    constexpr unsigned kRound = 24, kCapRings = 6, kTubeRings = 18;
    constexpr double kRadius = 0.15, kHalf = 0.35;
    std::vector<glm::dvec2> profile;  // x, distance from the axis
    for (unsigned ring = 1; ring < kCapRings; ++ring) {
        const double angle = 0.5 * std::numbers::pi * ring / kCapRings;
        profile.emplace_back(-kHalf - kRadius * std::cos(angle), kRadius * std::sin(angle));
    }
    for (unsigned ring = 0; ring <= kTubeRings; ++ring) {
        profile.emplace_back(kHalf * (2.0 * ring / kTubeRings - 1.0), kRadius);
    }
    for (unsigned ring = kCapRings - 1; ring > 0; --ring) {
        profile.emplace_back(-profile[ring - 1].x, profile[ring - 1].y);
    }
    Shape axis;
    axis.grow("capsule", {{-kHalf, 0.0, 0.0, kRadius}, {kHalf, 0.0, 0.0, kRadius}});
    Triangles mesh = revolve(profile, kHalf + kRadius, kRound);
    const std::size_t faces = mesh.faces.size();
    return {"capsule", std::move(mesh), axis.truth(), {.faces = faces, .ends = 2}};
}

Model make_torus() {
    constexpr unsigned kAround = 48, kTube = 16;
    constexpr double kRing = 0.35, kRadius = 0.15;
    Model model{"torus", {}, {}, {.faces = 2 * kAround * kTube, .genus = 1, .cycles = 1}};
    TruthLimb limb{"ring", {}};
    for (unsigned i = 0; i < kAround; ++i) {
        const glm::dvec3 out(std::cos(turn(i, kAround)), 0.0, std::sin(turn(i, kAround)));
        for (unsigned j = 0; j < kTube; ++j) {
            const double angle = turn(j, kTube);
            model.mesh.vertices.push_back((kRing + kRadius * std::cos(angle)) * out +
                                          glm::dvec3(0.0, kRadius * std::sin(angle), 0.0));
        }
        join_rings(model.mesh, i * kTube, (i + 1) % kAround * kTube, kTube);
        limb.nodes.push_back(i);
        model.truth.nodes.push_back({kRing * out, kRadius});
        model.truth.edges.emplace_back(i, (i + 1) % kAround);
    }
    model.truth.limbs.push_back(std::move(limb));
    return model;
}

Model make_y() {
    Shape shape;
    const LimbOptions options{.blend = 0.06};
    shape.grow("stem", {{0.0, -0.5, 0.0, 0.10}, {0.0, 0.0, 0.0, 0.10}}, options);
    shape.grow("right arm", {{0.0, 0.0, 0.0, 0.10}, {0.38, 0.34, 0.0, 0.08}}, options);
    shape.grow("left arm", {{0.0, 0.0, 0.0, 0.10}, {-0.30, 0.40, 0.0, 0.08}}, options);
    return mesh_shape("y", shape, {.faces = 1200, .ends = 3});
}

Model make_double_torus() {
    Shape shape;
    for (const double side : {-1.0, 1.0}) {
        std::vector<Ball> ring;
        for (unsigned i = 0; i < 16; ++i) {
            const double angle = turn(i, 16);
            ring.emplace_back(side * (0.26 - 0.19 * std::cos(angle)), 0.19 * std::sin(angle), 0.0,
                              0.08);
        }
        shape.grow(side < 0.0 ? "left ring" : "right ring", ring,
                   {.blend = 0.06, .reach = 0.3, .is_loop = true});
    }
    return mesh_shape("double_torus", shape, {.faces = 2000, .genus = 2, .cycles = 2});
}

}  // namespace zskel::models
