#include "zskel/mesh/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "zskel/mesh/self_intersections.h"
#include "zskel/mesh/topology.h"
#include "zskel/mesh/weld.h"

namespace zskel {
namespace {

/// Height over the longest side below which three corners lie on a line: rounding of doubles, with
/// room.
constexpr double kFlatRatio = 1e-12;

bool repeats_corner(const Triangle& t) {
    return t.x == t.y || t.y == t.z || t.z == t.x;
}

/// A mesh as extraction sees it, and the way back to the input's numbers.
struct Welded {
    std::vector<DVec3> places;
    std::vector<std::uint32_t> vertex_of_place;  ///< the first at it
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source;  ///< the input's triangle of every triangle
};

class MeshChecker {
  public:
    explicit MeshChecker(const Mesh& mesh) : mesh_(mesh) {}

    MeshReport check() {
        report_.name = mesh_.name;
        report_.hash = mesh_.hash;
        report_.warnings = mesh_.warnings;
        report_.vertices = mesh_.positions.size();
        report_.faces = mesh_.face_count;
        report_.triangles = mesh_.triangles.size();
        weld();
        drop_degenerate();
        drop_duplicates();
        note_flat();
        note_crossing();
        topology_ = find_topology(welded_.places.size(), welded_.triangles);
        note_edges();
        measure_components();
        note_components();
        return std::move(report_);
    }

  private:
    void note(std::string name, std::size_t count, std::string example, std::string action) {
        if (count == 0) return;
        report_.defects.push_back({std::move(name), count, std::move(example), std::move(action)});
    }

    std::string face_name(std::uint32_t input_triangle) const {
        return fmt::format("face {}", mesh_.face_of_triangle.empty()
                                          ? input_triangle
                                          : mesh_.face_of_triangle[input_triangle]);
    }

    std::string edge_name(const glm::uvec2& edge) const {
        return fmt::format("edge {}-{}", welded_.vertex_of_place[edge.x],
                           welded_.vertex_of_place[edge.y]);
    }

    void weld() {
        PlaceIndex index(mesh_.positions.size());
        std::vector<bool> is_used(mesh_.positions.size(), false);
        for (const Triangle& t : mesh_.triangles) {
            for (int k = 0; k < 3; ++k) is_used[t[k]] = true;
        }
        std::vector<std::uint32_t> place(mesh_.positions.size(), kNone);
        std::uint32_t first_coincident = kNone;
        std::uint32_t first_unused = kNone;
        for (std::uint32_t v = 0; v < place.size(); ++v) {
            if (!is_used[v]) {
                if (report_.unreferenced_vertices++ == 0) first_unused = v;
                continue;
            }
            place[v] = index.add(mesh_.positions[v]);
            if (place[v] == welded_.vertex_of_place.size()) {
                welded_.vertex_of_place.push_back(v);
            } else if (report_.coincident_vertices++ == 0) {
                first_coincident = v;
            }
        }
        welded_.places = index.take_places();
        for (const Triangle& t : mesh_.triangles) {
            welded_.triangles.emplace_back(place[t.x], place[t.y], place[t.z]);
        }
        note("unreferenced_vertices", report_.unreferenced_vertices,
             fmt::format("vertex {}", first_unused), "left out; they belong to no node");
        note("coincident_vertices", report_.coincident_vertices,
             fmt::format("vertex {}", first_coincident),
             "welded to the first one at the same position");
    }

    void note_crossing() {
        const auto found = crossing_triangles(welded_.places, welded_.triangles,
                                              bearable_pairs(welded_.triangles.size()));
        if (!found) return;
        report_.crossing_triangles = found->size();
        if (found->empty()) return;
        note("crossing_triangles", found->size(), face_name(welded_.source[found->front()]),
             "kept: within a solid the inside is where its winding number is not 0; --join makes "
             "one surface of what overlaps");
    }

    void drop_degenerate() {
        std::vector<Triangle> kept;
        std::uint32_t first = kNone;
        for (std::uint32_t t = 0; t < welded_.triangles.size(); ++t) {
            if (repeats_corner(welded_.triangles[t])) {
                if (report_.degenerate_triangles++ == 0) first = t;
                continue;
            }
            kept.push_back(welded_.triangles[t]);
            welded_.source.push_back(t);
        }
        welded_.triangles = std::move(kept);
        if (first == kNone) return;
        note("degenerate_triangles", report_.degenerate_triangles, face_name(first),
             "dropped: a corner repeats");
    }

    void drop_duplicates() {
        std::vector<std::array<std::uint32_t, 4>> keys;  // sorted corners, then the triangle
        for (std::uint32_t t = 0; t < welded_.triangles.size(); ++t) {
            const Triangle& corners = welded_.triangles[t];
            std::array<std::uint32_t, 4> key{corners.x, corners.y, corners.z, t};
            std::sort(key.begin(), key.begin() + 3);
            keys.push_back(key);
        }
        std::sort(keys.begin(), keys.end());
        std::vector<bool> is_duplicate(keys.size(), false);
        for (std::size_t i = 1; i < keys.size(); ++i) {
            is_duplicate[keys[i][3]] =
                std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin());
        }
        std::uint32_t first = kNone;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < is_duplicate.size(); ++t) {
            if (is_duplicate[t]) {
                if (report_.duplicate_triangles++ == 0) first = welded_.source[t];
                continue;
            }
            welded_.triangles[kept] = welded_.triangles[t];
            welded_.source[kept++] = welded_.source[t];
        }
        welded_.triangles.resize(kept);
        welded_.source.resize(kept);
        if (first == kNone) return;
        note("duplicate_triangles", report_.duplicate_triangles, face_name(first),
             "dropped: an earlier one has the same corners");
    }

    bool is_flat(const Triangle& t) const {
        const DVec3 a = welded_.places[t.x];
        std::array<DVec3, 3> sides{welded_.places[t.y] - a, welded_.places[t.z] - a,
                                   welded_.places[t.z] - welded_.places[t.y]};
        double longest = 0.0;
        for (const DVec3& side : sides) {
            longest = std::max({longest, std::abs(side.x), std::abs(side.y), std::abs(side.z)});
        }
        // Scaled first: products of very small or large sides leave the range of a double.
        return glm::length(glm::cross(sides[0] / longest, sides[1] / longest)) <= kFlatRatio;
    }

    void note_flat() {
        std::uint32_t first = kNone;
        for (std::size_t t = 0; t < welded_.triangles.size(); ++t) {
            if (!is_flat(welded_.triangles[t])) continue;
            if (report_.flat_triangles++ == 0) first = welded_.source[t];
        }
        if (first == kNone) return;
        note("flat_triangles", report_.flat_triangles, face_name(first),
             "kept, so that no hole opens; they have no normal");
    }

    void note_edges() {
        report_.boundary_edges = topology_.boundary_edges.size();
        report_.boundary_loops = topology_.boundary_loops.size();
        report_.non_manifold_edges = topology_.non_manifold_edges.size();
        report_.non_manifold_vertices = topology_.non_manifold_vertices.size();
        report_.inconsistent_edges = topology_.inconsistent_edges.size();
        if (report_.boundary_edges > 0) {
            const std::uint32_t vertex = topology_.boundary_loops[0][0];
            note("boundary_loops", report_.boundary_loops,
                 fmt::format("loop at vertex {}", welded_.vertex_of_place[vertex]),
                 "closed with caps, which are seen and repel and are in no output; sheets and what "
                 "no cap "
                 "fits stay open, with a warning");
        }
        if (report_.non_manifold_edges > 0) {
            note("non_manifold_edges", report_.non_manifold_edges,
                 edge_name(topology_.non_manifold_edges[0]),
                 "fins and walls inside are left out, the rest is parted in pairs; what cannot be "
                 "is kept, "
                 "with a warning");
        }
        if (report_.non_manifold_vertices > 0) {
            const std::uint32_t vertex = topology_.non_manifold_vertices[0];
            note("non_manifold_vertices", report_.non_manifold_vertices,
                 fmt::format("vertex {}", welded_.vertex_of_place[vertex]),
                 "kept: parts that only touch there are seen apart");
        }
        if (report_.inconsistent_edges > 0) {
            note("inconsistent_edges", report_.inconsistent_edges,
                 edge_name(topology_.inconsistent_edges[0]),
                 "faces are turned to agree with their neighbours where they can");
        }
    }

    void measure_components() {
        for (const TopologyComponent& part : topology_.components) {
            ComponentReport component;
            component.triangles = part.triangle_count;
            component.boundary_loops = part.boundary_loops;
            component.is_closed = part.is_closed;
            component.is_manifold = part.is_manifold;
            component.is_oriented = part.is_oriented;
            component.is_orientable = part.is_orientable;
            component.genus = part.genus;
            report_.components.push_back(component);
        }
        measure_boxes();
        measure_volumes();
        sum_up();
    }

    void measure_boxes() {
        for (std::size_t t = 0; t < welded_.triangles.size(); ++t) {
            Box& box = report_.components[topology_.component_of_triangle[t]].box;
            for (int k = 0; k < 3; ++k) {
                const DVec3& position = welded_.places[welded_.triangles[t][k]];
                box.add(position);
                report_.box.add(position);
            }
        }
        if (welded_.triangles.empty()) report_.box = {DVec3(0.0), DVec3(0.0)};
    }

    /// Six times a component's volume is the sum of the determinants of its triangles, taken from
    /// the middle of its box, so that a model far from the origin loses no digits.
    void measure_volumes() {
        std::vector<double> sums(report_.components.size(), 0.0);
        for (std::size_t t = 0; t < welded_.triangles.size(); ++t) {
            const std::uint32_t part = topology_.component_of_triangle[t];
            const Box& box = report_.components[part].box;
            const DVec3 middle = box.low * 0.5 + box.high * 0.5;
            const Triangle& corners = welded_.triangles[t];
            const double determinant = glm::dot(
                welded_.places[corners.x] - middle,
                glm::cross(welded_.places[corners.y] - middle, welded_.places[corners.z] - middle));
            sums[part] += topology_.is_turned[t] ? -determinant : determinant;
        }
        for (std::size_t i = 0; i < sums.size(); ++i) {
            ComponentReport& component = report_.components[i];
            if (component.is_closed && component.is_orientable) component.volume = sums[i] / 6.0;
        }
    }

    void sum_up() {
        if (!report_.components.empty()) report_.genus = 0;
        for (const ComponentReport& component : report_.components) {
            if (component.volume) report_.volume = report_.volume.value_or(0.0) + *component.volume;
            if (report_.genus && component.genus) {
                *report_.genus += *component.genus;
            } else {
                report_.genus.reset();
            }
        }
    }

    template <typename Condition>
    void note_components(const std::string& name, Condition condition, const std::string& action) {
        const auto& all = report_.components;
        const auto first = std::find_if(all.begin(), all.end(), condition);
        note(name, static_cast<std::size_t>(std::count_if(first, all.end(), condition)),
             fmt::format("component {}", first - all.begin()), action);
    }

    void note_components() {
        note_components(
            "non_orientable_components", [](const auto& c) { return !c.is_orientable; },
            "kept; normals disagree somewhere, whichever way faces are turned");
        note_components(
            "inside_out_components", [](const auto& c) { return c.volume.value_or(0.0) < 0.0; },
            "turned to face outward; a closed one within another is its cavity either way");
        if (report_.components.size() < 2) return;
        note("several_components", report_.components.size(), "component 0",
             "each closed outer shell, with the cavities in it, and each open part gets a skeleton "
             "of its own");
    }

    const Mesh& mesh_;
    Welded welded_;
    Topology topology_;
    MeshReport report_;
};

}  // namespace

MeshReport check_mesh(const Mesh& mesh) {
    return MeshChecker(mesh).check();
}

}  // namespace zskel
