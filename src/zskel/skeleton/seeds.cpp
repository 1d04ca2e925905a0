#include "zskel/skeleton/seeds.h"

#include <algorithm>

#include "zskel/core/parallel.h"

namespace zskel {
namespace {

constexpr float kClearOfVertex =
    1e-5f;  // where the inward ray starts, past the vertex's own triangles

}  // namespace

std::vector<float> vertex_thickness(const Surface& surface, const SurfaceQuery& query) {
    std::vector<float> thickness(surface.positions.size());
    parallel_for(thickness.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Vec3& vertex = surface.positions[v];
            const Vec3 inward = -surface.vertex_normals[v];
            thickness[v] =
                std::max(query.free_way(vertex + inward * kClearOfVertex, inward), kClearOfVertex);
        }
    });
    return thickness;
}

std::vector<Vec3> inner_points(const Surface& surface, std::span<const float> thickness,
                               const SeedOptions& options) {
    std::vector<Vec3> points;
    points.reserve(thickness.size());
    for (std::size_t v = 0; v < thickness.size(); ++v) {
        const double deepest = options.max_offset_thickness * static_cast<double>(thickness[v]);
        const auto offset = static_cast<float>(std::min(options.offset_world, deepest));
        points.push_back(surface.positions[v] - surface.vertex_normals[v] * offset);
    }
    return points;
}

std::vector<Seed> place_seeds(const Surface& surface, const SurfaceQuery& query,
                              const SeedOptions& options) {
    std::vector<Seed> seeds;
    seeds.reserve(surface.positions.size());
    for (const Vec3& point : inner_points(surface, vertex_thickness(surface, query), options)) {
        seeds.push_back({point, static_cast<std::uint32_t>(seeds.size())});
    }
    return seeds;
}

}  // namespace zskel
