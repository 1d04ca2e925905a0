#include "zskel/skeleton/seeds.h"

#include <algorithm>

#include "zskel/core/parallel.h"

namespace zskel {
namespace {

constexpr float kLongestChord = 2.0f;  // more than the diagonal of the unit cube
constexpr float kClearOfVertex =
    1e-5f;  // where the inward ray starts, past the vertex's own triangles

}  // namespace

std::vector<Seed> place_seeds(const Surface& surface, const SurfaceQuery& query,
                              const SeedOptions& options) {
    std::vector<Seed> seeds(surface.positions.size());
    parallel_for(seeds.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Vec3& vertex = surface.positions[v];
            const Vec3 inward = -surface.vertex_normals[v];
            double offset = options.offset_world;
            const auto hit =
                query.first_hit(vertex + inward * kClearOfVertex, vertex + inward * kLongestChord);
            if (hit) {
                offset = std::min(offset, options.max_offset_thickness *
                                              static_cast<double>(hit->fraction * kLongestChord));
            }
            seeds[v] = {vertex + inward * static_cast<float>(offset),
                        static_cast<std::uint32_t>(v)};
        }
    });
    return seeds;
}

}  // namespace zskel
