#include "zskel/mesh/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/cracks.h"
#include "zskel/mesh/crowded_edges.h"
#include "zskel/mesh/orient.h"
#include "zskel/mesh/outlook.h"
#include "zskel/mesh/sides.h"

namespace zskel {
namespace {

constexpr double kClearOutlook = 0.05;  // by how much a share must be more

// Halved first: the extent of a model near the limits of a double must not overflow. A scale of 0:
// there is no extent that can be scaled.
Similarity unit_cube(std::span<const DVec3> positions) {
    DVec3 low(std::numeric_limits<double>::max());
    DVec3 high(std::numeric_limits<double>::lowest());
    for (const DVec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const DVec3 half = high * 0.5 - low * 0.5;
    const double size = 2.0 * std::max({half.x, half.y, half.z});
    const bool can_scale = size > 0.0 && std::isfinite(size) && std::isfinite(1.0 / size);
    return {low + half, can_scale ? 1.0 / size : 0.0};
}

// Second moments of the triangles about their common centroid, in the unit cube so that nothing
// overflows.
Similarity by_spread(std::span<const DVec3> positions, std::span<const Triangle> triangles,
                     const Similarity& cube, const Similarity& otherwise) {
    double area_sum = 0.0;
    DVec3 first(0.0);
    double second = 0.0;
    for (const Triangle& t : triangles) {
        const DVec3 a = (positions[t.x] - cube.center) * cube.scale;
        const DVec3 b = (positions[t.y] - cube.center) * cube.scale;
        const DVec3 c = (positions[t.z] - cube.center) * cube.scale;
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        const DVec3 sum = a + b + c;
        area_sum += area;
        first += sum * (area / 3.0);
        second +=
            area / 12.0 * (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c) + glm::dot(sum, sum));
    }
    if (!(area_sum > 0.0)) return otherwise;
    const DVec3 centroid = first / area_sum;
    const double variance = second / area_sum - glm::dot(centroid, centroid);
    if (!(variance > 0.0)) return otherwise;
    return {cube.center + centroid / cube.scale, cube.scale * kWorldSpread / std::sqrt(variance)};
}

bool has_edge(const std::vector<Side>& sides, bool (*is_meant)(std::size_t)) {
    bool has = false;
    for_each_edge(
        sides, [&](std::size_t first, std::size_t last) { has = has || is_meant(last - first); });
    return has;
}

// The sides of the triangles once no edge has fewer or more of them than two where that can be
// mended.
std::vector<Side> mend_edges(WeldedMesh& mesh, const RepairOptions& options,
                             std::vector<Repair>& repairs) {
    const auto sides_now = [&] { return sorted_sides(mesh.triangles, mesh.positions.size()); };
    std::vector<Side> sides = sides_now();
    if (has_edge(sides, [](std::size_t triangles) { return triangles < 2; })) {
        close_cracks(mesh, options.weld_tolerance_diagonals * diagonal_of(mesh), repairs);
        drop_duplicates(mesh, repairs);
        sides = sides_now();
    }
    if (has_edge(sides, [](std::size_t triangles) { return triangles > 2; })) {
        mend_crowded_edges(mesh, repairs);
        sides = sides_now();
    }
    return sides;
}

// Turns open parts that see less of the outside from their fronts than from their backs.
void turn_by_outlook(WeldedMesh& mesh, const Orientation& parts, std::vector<Repair>& repairs) {
    std::vector<std::uint32_t> group(mesh.triangles.size(), kNone);
    bool is_any = false;
    for (std::size_t t = 0; t < group.size(); ++t) {
        const std::uint32_t c = parts.component[t];
        if (parts.component_closed[c] || !parts.component_orientable[c]) continue;
        group[t] = c;
        is_any = true;
    }
    if (!is_any) return;
    const std::vector<Outlook> views = look_out(mesh, group, parts.component_count);
    std::vector<bool> is_turned(parts.component_count, false);
    for (std::size_t c = 0; c < views.size(); ++c)
        is_turned[c] = views[c].back > views[c].front + kClearOutlook;
    for (std::size_t t = 0; t < group.size(); ++t) {
        if (group[t] != kNone && is_turned[group[t]])
            std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
    }
    note(repairs, "open parts turned so that their fronts see more of the outside",
         static_cast<std::size_t>(std::count(is_turned.begin(), is_turned.end(), true)));
}

void note_what_is_left(const Orientation& parts, std::vector<Repair>& repairs) {
    const auto open =
        std::count(parts.component_closed.begin(), parts.component_closed.end(), false);
    if (open > 0) {
        note(repairs, "boundary edges left open: what is seen through them does not repel",
             parts.open_edges);
    }
    note(repairs, "non-manifold edges kept: topology is not guaranteed", parts.crowded_edges);
}

void refuse_repairs(const Mesh& mesh, const std::vector<Repair>& repairs) {
    std::string all;
    for (const Repair& repair : repairs)
        all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", repair.what, repair.count);
    if (!all.empty())
        throw InputError(
            fmt::format("{}: needs repairs, and none are allowed: {}", mesh.name, all));
}

}  // namespace

Similarity scale_by_spread(std::span<const DVec3> positions, std::span<const Triangle> triangles,
                           const Similarity& otherwise) {
    const Similarity cube = unit_cube(positions);
    return cube.scale == 0.0 ? otherwise : by_spread(positions, triangles, cube, otherwise);
}

PreparedSurface prepare_surface(const Mesh& mesh, WorldSize size, const RepairOptions& options) {
    PreparedSurface out;
    WeldedMesh welded = weld_equal(mesh, out.repairs);
    drop_duplicates(welded, out.repairs);
    std::vector<Side> sides = mend_edges(welded, options, out.repairs);
    if (welded.triangles.empty()) {
        throw InputError(fmt::format("{}: no face with three different corners is left of {}",
                                     mesh.name, mesh.triangles.size()));
    }
    Orientation parts = orient(welded, std::move(sides), out.repairs);
    if (options.has_caps) out.openings = cap_openings(welded, parts, out.repairs);
    turn_by_outlook(welded, parts, out.repairs);
    note_what_is_left(parts, out.repairs);
    if (!options.is_allowed) refuse_repairs(mesh, out.repairs);

    const Similarity cube = unit_cube(welded.positions);
    if (cube.scale == 0.0) {
        throw InputError(
            fmt::format("{}: the model's extent is not a positive, finite number that "
                        "it can be scaled by",
                        mesh.name));
    }
    out.surface.world_from_model = size == WorldSize::UnitCube
                                       ? cube
                                       : by_spread(welded.positions, welded.triangles, cube, cube);
    out.surface.positions.reserve(welded.positions.size());
    for (const DVec3& p : welded.positions) {
        out.surface.positions.push_back(out.surface.world_from_model.to_world(p));
    }
    for (std::uint32_t v = 0; v < welded.positions.size(); ++v) {
        if (welded.positions[v] != mesh.positions[welded.vertex[v]])
            out.put_in.emplace_back(v, welded.positions[v]);
    }
    if (size == WorldSize::Spread && parts.component_count > 1)
        out.places = std::move(welded.positions);
    out.surface.triangles = std::move(welded.triangles);
    out.surface.edges = std::move(parts.edges);
    // Caps have edges of their own, and what was left out has none.
    if (parts.open_edges > 0 && options.has_caps) derive_edges(out.surface);
    out.input_triangle = std::move(welded.input_triangle);
    out.surface_vertex = std::move(welded.place);
    out.input_vertex = std::move(welded.vertex);
    out.component = std::move(parts.component);
    out.component_count = parts.component_count;
    out.component_closed = std::move(parts.component_closed);
    out.component_sheet = std::move(parts.component_sheet);
    out.fans_are_whole = parts.fans_are_whole;
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

std::vector<Triangle> input_triangles(const PreparedSurface& prepared) {
    const std::vector<std::uint32_t>& vertex = prepared.input_vertex;
    std::vector<Triangle> out;
    out.reserve(prepared.surface.triangles.size());
    for (const Triangle& t : prepared.surface.triangles)
        out.emplace_back(vertex[t.x], vertex[t.y], vertex[t.z]);
    return out;
}

}  // namespace zskel
