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
    std::vector<Face> faces;
    faces.reserve(welded.triangles.size());
    for (const Triangle& t : welded.triangles)
        faces.push_back({sorted_corners(t), static_cast<std::uint32_t>(faces.size())});
    faces = bucket_sorted(
        faces, welded.positions.size(), [](const Face& f) { return f.corners[0]; },
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

// Twice the signed volume over three of the component's triangles, taken from its centroid:
// positive when they face outward, closed or nearly so.
double signed_volume(const Welded& welded, const std::vector<std::uint32_t>& members) {
    DVec3 centroid(0.0);
    for (const std::uint32_t t : members) centroid += welded.positions[welded.triangles[t].x];
    centroid /= static_cast<double>(members.size());
    double volume = 0.0;
    for (const std::uint32_t t : members) {
        const Triangle& tri = welded.triangles[t];
        volume += glm::dot(
            welded.positions[tri.x] - centroid,
            glm::cross(welded.positions[tri.y] - centroid, welded.positions[tri.z] - centroid));
    }
    return volume;
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

// Walks every component over edges with two triangles, turning neighbours that disagree, then turns
// the whole component when it faces inward.
void orient(Welded& welded, PreparedSurface& out) {
    const std::vector<Side> sides = sorted_sides(welded.triangles, welded.positions.size());
    struct Link {
        std::uint32_t triangle;
        bool agrees;
    };
    // Neighbours over every edge, those of a triangle one after the other.
    std::vector<std::uint32_t> first_link(welded.triangles.size() + 1, 0);
    std::vector<bool> touches_odd_edge(welded.triangles.size(), false);
    std::size_t open_edges = 0;
    std::size_t crowded_edges = 0;
    for_each_edge(sides, [&](std::size_t first, std::size_t last) {
        const std::size_t count = last - first;
        out.surface.edges.push_back(sides[first].edge);
        open_edges += count == 1 ? 1 : 0;
        crowded_edges += count > 2 ? 1 : 0;
        for (std::size_t i = first; i < last && count != 2; ++i) {
            touches_odd_edge[sides[i].triangle] = true;
        }
        for (std::size_t i = first; i + 1 < last; ++i) {
            ++first_link[sides[i].triangle + 1];
            ++first_link[sides[i + 1].triangle + 1];
        }
    });
    out.fans_are_whole = has_whole_fans(sides, welded);
    std::partial_sum(first_link.begin(), first_link.end(), first_link.begin());
    std::vector<Link> links(first_link.back());
    std::vector<std::uint32_t> next_link(first_link.begin(), first_link.end() - 1);
    for_each_edge(sides, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i + 1 < last; ++i) {
            const Side& a = sides[i];
            const Side& b = sides[i + 1];
            const bool agrees = a.is_forward != b.is_forward || last - first > 2;
            links[next_link[a.triangle]++] = {b.triangle, agrees};
            links[next_link[b.triangle]++] = {a.triangle, agrees};
        }
    });

    std::size_t turned_faces = 0;
    std::size_t turned_components = 0;
    std::size_t contradictions = 0;
    out.component.assign(welded.triangles.size(), kNone);
    std::vector<bool> turned(welded.triangles.size(), false);
    for (std::uint32_t start = 0; start < welded.triangles.size(); ++start) {
        if (out.component[start] != kNone) continue;
        std::vector<std::uint32_t> members{start};
        out.component[start] = out.component_count;
        bool closed = true;
        for (std::size_t next = 0; next < members.size(); ++next) {
            const std::uint32_t t = members[next];
            closed = closed && !touches_odd_edge[t];
            for (std::uint32_t l = first_link[t]; l < first_link[t + 1]; ++l) {
                const Link& link = links[l];
                const bool turn = turned[t] != !link.agrees;
                if (out.component[link.triangle] == kNone) {
                    out.component[link.triangle] = out.component_count;
                    turned[link.triangle] = turn;
                    members.push_back(link.triangle);
                } else if (turned[link.triangle] != turn) {
                    ++contradictions;
                }
            }
        }
        std::size_t turns = 0;
        for (const std::uint32_t t : members) {
            turns += turned[t] ? 1 : 0;
            if (turned[t]) std::swap(welded.triangles[t].y, welded.triangles[t].z);
        }
        turned_faces += std::min(turns, members.size() - turns);
        if (signed_volume(welded, members) < 0.0) {
            for (const std::uint32_t t : members) {
                std::swap(welded.triangles[t].y, welded.triangles[t].z);
            }
            turned_components += turns * 2 < members.size() ? 1 : 0;
        }
        out.component_closed.push_back(closed);
        ++out.component_count;
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
             contradictions / 2});
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
    surface.triangle_normals.assign(surface.triangles.size(), Vec3(0.0f));
    std::vector<DVec3> sums(surface.positions.size(), DVec3(0.0));
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
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
            const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
            sums[tri[k]] += normal / length * angle;
        }
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
