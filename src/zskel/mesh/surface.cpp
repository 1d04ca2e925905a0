#include "zskel/mesh/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "zskel/core/bucket_sort.h"
#include "zskel/core/disjoint_sets.h"
#include "zskel/core/error.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/sides.h"
#include "zskel/mesh/weld.h"

namespace zskel {
namespace {

std::array<std::uint32_t, 3> sorted_corners(const Triangle& t) {
    std::array<std::uint32_t, 3> corners{t.x, t.y, t.z};
    std::sort(corners.begin(), corners.end());
    return corners;
}

// Numbers the places that triangles use; `positions` come back in model space.
struct Welded {
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;
};

Welded weld(const Mesh& mesh, PreparedSurface& out) {
    Welded welded;
    out.surface_vertex.assign(mesh.positions.size(), kNone);
    PlaceIndex places(mesh.positions.size());
    std::size_t merged = 0;
    std::size_t collapsed = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        Triangle corners;
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& place = out.surface_vertex[triangle[k]];
            if (place == kNone) {
                const std::size_t known = places.places().size();
                place = places.add(mesh.positions[triangle[k]]);
                merged += places.places().size() == known ? 1 : 0;
            }
            corners[k] = place;
        }
        const bool repeats =
            corners.x == corners.y || corners.y == corners.z || corners.z == corners.x;
        collapsed += repeats ? 1 : 0;
        if (repeats) continue;
        welded.triangles.push_back(corners);
        out.input_triangle.push_back(t);
    }
    welded.positions = places.take_places();
    const auto unused = static_cast<std::size_t>(
        std::count(out.surface_vertex.begin(), out.surface_vertex.end(), kNone));
    if (merged > 0)
        out.repairs.push_back({"vertices welded to another at the same position", merged});
    if (collapsed > 0) out.repairs.push_back({"degenerate faces dropped", collapsed});
    if (unused > 0) out.repairs.push_back({"vertices without a face left out", unused});
    return welded;
}

void drop_duplicates(Welded& welded, PreparedSurface& out) {
    struct Face {
        std::array<std::uint32_t, 3> corners;
        std::uint32_t number;
    };
    const auto for_each_face = [&](const auto& visit) {
        std::uint32_t number = 0;
        for (const Triangle& t : welded.triangles) visit({sorted_corners(t), number++});
    };
    const std::vector<Face> faces = bucket_sorted<Face>(
        for_each_face, welded.positions.size(), [](const Face& f) { return f.corners[0]; },
        [](const Face& l, const Face& r) {
            return std::tie(l.corners, l.number) < std::tie(r.corners, r.number);
        });
    std::vector<bool> dropped(faces.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].corners != faces[i - 1].corners) continue;
        dropped[faces[i].number] = true;
        ++count;
    }
    if (count == 0) return;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < dropped.size(); ++t) {
        if (dropped[t]) continue;
        welded.triangles[kept] = welded.triangles[t];
        out.input_triangle[kept++] = out.input_triangle[t];
    }
    welded.triangles.resize(kept);
    out.input_triangle.resize(kept);
    out.repairs.push_back({"duplicate faces dropped", count});
}

// Triangles that hang together, each with whether it has to be turned to agree with the lowest.
class TurnedSets {
  public:
    explicit TurnedSets(std::size_t count) {
        links_.reserve(count);
        for (std::uint32_t t = 0; t < count; ++t) links_.push_back(t << 1);
    }

    struct Found {
        std::uint32_t lowest;
        bool turned;
    };
    Found find(std::uint32_t t) {
        bool turned = false;
        while (links_[t] >> 1 != t) {
            links_[t] = links_[links_[t] >> 1] ^ (links_[t] & 1);  // halves the way
            turned = turned != ((links_[t] & 1) != 0);
            t = links_[t] >> 1;
        }
        return {t, turned};
    }

    // False when they already hang together the other way round.
    bool unite(std::uint32_t t, std::uint32_t u, bool turn) {
        Found a = find(t);
        Found b = find(u);
        if (a.lowest == b.lowest) return (a.turned != b.turned) == turn;
        if (b.lowest < a.lowest) std::swap(a, b);
        links_[b.lowest] = a.lowest << 1 | ((a.turned != b.turned) != turn ? 1u : 0u);
        return true;
    }

  private:
    std::vector<std::uint32_t> links_;  // towards the lowest; the lowest bit: turned against it
};

// Twice the signed volume over three of every component's triangles, taken from its centroid:
// positive when they face outward, closed or nearly so.
std::vector<double> signed_volumes(const Welded& welded, const PreparedSurface& out) {
    std::vector<DVec3> centroids(out.component_count, DVec3(0.0));
    std::vector<double> counts(out.component_count, 0.0);
    for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
        centroids[out.component[t]] += welded.positions[welded.triangles[t].x];
        counts[out.component[t]] += 1.0;
    }
    for (std::size_t c = 0; c < centroids.size(); ++c) centroids[c] /= counts[c];
    std::vector<double> volumes(out.component_count, 0.0);
    for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
        const Triangle& tri = welded.triangles[t];
        const DVec3& centroid = centroids[out.component[t]];
        volumes[out.component[t]] += glm::dot(
            welded.positions[tri.x] - centroid,
            glm::cross(welded.positions[tri.y] - centroid, welded.positions[tri.z] - centroid));
    }
    return volumes;
}

// Whether the triangles at every vertex hang together over edges.
bool has_whole_fans(const std::vector<Side>& sides, const Welded& welded) {
    DisjointSets corners(welded.triangles.size() * 3);
    std::size_t fans = welded.triangles.size() * 3;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].edge != sides[i - 1].edge) continue;
        fans -= corners.unite(sides[i].low_corner(), sides[i - 1].low_corner()) ? 1 : 0;
        fans -= corners.unite(sides[i].high_corner(), sides[i - 1].high_corner()) ? 1 : 0;
    }
    return fans == welded.positions.size();
}

// Joins neighbours over every edge into components, turns those that disagree with the rest, and
// whole components that face inward.
void orient(Welded& welded, PreparedSurface& out) {
    const std::size_t count = welded.triangles.size();
    std::vector<bool> touches_odd_edge(count, false);
    std::size_t open_edges = 0;
    std::size_t crowded_edges = 0;
    std::size_t contradictions = 0;
    TurnedSets sets(count);
    // Neighbours over edges of more than two faces: which of them turns with which cannot be told.
    std::vector<glm::uvec2> crowd;
    {
        const std::vector<Side> sides = sorted_sides(welded.triangles, welded.positions.size());
        for_each_edge(sides, [&](std::size_t first, std::size_t last) {
            const std::size_t share = last - first;
            out.surface.edges.push_back(sides[first].edge);
            open_edges += share == 1 ? 1 : 0;
            crowded_edges += share > 2 ? 1 : 0;
            for (std::size_t i = first; i < last && share != 2; ++i)
                touches_odd_edge[sides[i].triangle] = true;
            for (std::size_t i = first; i + 1 < last; ++i) {
                const Side& a = sides[i];
                const Side& b = sides[i + 1];
                if (share > 2) {
                    crowd.emplace_back(a.triangle, b.triangle);
                    continue;
                }
                const bool agrees = a.is_forward != b.is_forward;
                contradictions += sets.unite(a.triangle, b.triangle, !agrees) ? 0 : 1;
            }
        });
        out.fans_are_whole = has_whole_fans(sides, welded);
    }
    for (const glm::uvec2& pair : crowd) sets.unite(pair.x, pair.y, false);

    out.component.assign(count, kNone);
    std::vector<std::size_t> sizes;
    std::vector<std::size_t> turns;
    for (std::uint32_t t = 0; t < count; ++t) {
        const TurnedSets::Found found = sets.find(t);
        if (found.lowest == t) {
            out.component[t] = out.component_count++;
            out.component_closed.push_back(true);
            sizes.push_back(0);
            turns.push_back(0);
        }
        const std::uint32_t c = out.component[t] = out.component[found.lowest];
        if (touches_odd_edge[t]) out.component_closed[c] = false;
        ++sizes[c];
        if (!found.turned) continue;
        ++turns[c];
        std::swap(welded.triangles[t].y, welded.triangles[t].z);
    }
    const std::vector<double> volumes = signed_volumes(welded, out);
    for (std::size_t t = 0; t < count; ++t) {
        if (volumes[out.component[t]] < 0.0)
            std::swap(welded.triangles[t].y, welded.triangles[t].z);
    }
    std::size_t turned_faces = 0;
    std::size_t turned_components = 0;
    for (std::size_t c = 0; c < volumes.size(); ++c) {
        turned_faces += std::min(turns[c], sizes[c] - turns[c]);
        turned_components += volumes[c] < 0.0 && turns[c] * 2 < sizes[c] ? 1 : 0;
    }
    if (turned_faces > 0)
        out.repairs.push_back({"faces turned to agree with their neighbours", turned_faces});
    if (turned_components > 0)
        out.repairs.push_back({"inside-out components turned", turned_components});
    if (open_edges > 0) {
        out.repairs.push_back(
            {"boundary edges left open: what is seen through them does not repel", open_edges});
    }
    if (crowded_edges > 0) {
        out.repairs.push_back(
            {"non-manifold edges kept: topology is not guaranteed", crowded_edges});
    }
    if (contradictions > 0) {
        out.repairs.push_back(
            {"edges where no consistent orientation exists: there, inside and outside are not "
             "known",
             contradictions});
    }
}

Similarity unit_cube(const std::vector<DVec3>& positions, const std::string& name) {
    DVec3 low(std::numeric_limits<double>::max());
    DVec3 high(std::numeric_limits<double>::lowest());
    for (const DVec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    // Halved first: the extent of a model near the limits of a double must not overflow.
    const DVec3 half = high * 0.5 - low * 0.5;
    const double size = 2.0 * std::max({half.x, half.y, half.z});
    if (!(size > 0.0) || !std::isfinite(size) || !std::isfinite(1.0 / size)) {
        throw InputError(fmt::format(
            "{}: the model's extent is {}; it needs a positive, finite one", name, size));
    }
    return {low + half, 1.0 / size};
}

// Second moments of the triangles about their common centroid, in the unit cube so that nothing
// overflows.
Similarity by_spread(const Welded& welded, const Similarity& cube) {
    double area_sum = 0.0;
    DVec3 first(0.0);
    double second = 0.0;
    for (const Triangle& t : welded.triangles) {
        const DVec3 a = (welded.positions[t.x] - cube.center) * cube.scale;
        const DVec3 b = (welded.positions[t.y] - cube.center) * cube.scale;
        const DVec3 c = (welded.positions[t.z] - cube.center) * cube.scale;
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        const DVec3 sum = a + b + c;
        area_sum += area;
        first += sum * (area / 3.0);
        second +=
            area / 12.0 * (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c) + glm::dot(sum, sum));
    }
    if (!(area_sum > 0.0)) return cube;
    const DVec3 centroid = first / area_sum;
    const double variance = second / area_sum - glm::dot(centroid, centroid);
    if (!(variance > 0.0)) return cube;
    return {cube.center + centroid / cube.scale, cube.scale * kWorldSpread / std::sqrt(variance)};
}

}  // namespace

PreparedSurface prepare_surface(const Mesh& mesh, WorldSize size) {
    PreparedSurface out;
    Welded welded = weld(mesh, out);
    drop_duplicates(welded, out);
    if (welded.triangles.empty()) {
        throw InputError(fmt::format("{}: no face with three different corners is left of {}",
                                     mesh.name, mesh.triangles.size()));
    }
    orient(welded, out);
    out.surface.world_from_model = unit_cube(welded.positions, mesh.name);
    if (size == WorldSize::Spread)
        out.surface.world_from_model = by_spread(welded, out.surface.world_from_model);
    out.surface.positions.reserve(welded.positions.size());
    for (const DVec3& p : welded.positions) {
        out.surface.positions.push_back(out.surface.world_from_model.to_world(p));
    }
    out.surface.triangles = std::move(welded.triangles);
    derive_normals(out.surface);
    const bool flat =
        std::all_of(out.surface.triangle_normals.begin(), out.surface.triangle_normals.end(),
                    [](const Vec3& n) { return n == Vec3(0.0f); });
    if (flat) throw InputError(fmt::format("{}: no face has an area", mesh.name));
    return out;
}

void derive_normals(Surface& surface) {
    const std::size_t count = surface.triangles.size();
    surface.triangle_normals.assign(count, Vec3(0.0f));
    std::vector<DVec3> angles(count, DVec3(0.0));  // at the three corners
    parallel_for(count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const Triangle& tri = surface.triangles[t];
            const std::array<DVec3, 3> p{surface.positions[tri.x], surface.positions[tri.y],
                                         surface.positions[tri.z]};
            const DVec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double length = glm::length(normal);
            if (!(length > 0.0)) continue;
            surface.triangle_normals[t] = Vec3(normal / length);
            for (int k = 0; k < 3; ++k) {
                const DVec3 a = p[(k + 1) % 3] - p[k];
                const DVec3 b = p[(k + 2) % 3] - p[k];
                angles[t][k] = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
            }
        }
    });
    std::vector<DVec3> sums(surface.positions.size(), DVec3(0.0));
    for (std::size_t t = 0; t < count; ++t) {
        const DVec3 normal(surface.triangle_normals[t]);
        for (int k = 0; k < 3; ++k) sums[surface.triangles[t][k]] += normal * angles[t][k];
    }
    surface.vertex_normals.clear();
    surface.vertex_normals.reserve(sums.size());
    for (const DVec3& sum : sums) {
        const double length = glm::length(sum);
        surface.vertex_normals.emplace_back(length > 0.0 ? Vec3(sum / length) : Vec3(0.0f));
    }
}

void derive_edges(Surface& surface) {
    surface.edges.clear();
    const std::vector<Side> sides = sorted_sides(surface.triangles, surface.positions.size());
    for_each_edge(
        sides, [&](std::size_t first, std::size_t) { surface.edges.push_back(sides[first].edge); });
}

}  // namespace zskel
