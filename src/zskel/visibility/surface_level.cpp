#include "zskel/visibility/surface_level.h"

#include <meshoptimizer.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zskel {

std::optional<SurfaceLevel> coarser_level(const Surface& surface, double share) {
    static_assert(sizeof(Triangle) == 3 * sizeof(unsigned int) &&
                  sizeof(Vec3) == 3 * sizeof(float));
    constexpr std::size_t kCorners = 3;
    constexpr float kAnyError = 1.0f;
    const auto* corners = &surface.triangles.front().x;
    const auto* places = &surface.positions.front().x;
    const std::size_t all = kCorners * surface.triangles.size();
    const auto wanted =
        kCorners * static_cast<std::size_t>(share * static_cast<double>(surface.triangles.size()));
    std::vector<unsigned int> left(all);
    float error = 0.0f;
    left.resize(meshopt_simplifySloppy(left.data(), corners, all, places, surface.positions.size(),
                                       sizeof(Vec3), wanted, kAnyError, &error));
    if (left.empty()) return std::nullopt;
    SurfaceLevel level;
    level.error_world =
        error * meshopt_simplifyScale(places, surface.positions.size(), sizeof(Vec3));
    // Only what is still used.
    std::vector<std::uint32_t> number(surface.positions.size(), kNone);
    for (unsigned int& corner : left) {
        std::uint32_t& n = number[corner];
        if (n == kNone) {
            n = static_cast<std::uint32_t>(level.surface.positions.size());
            level.surface.positions.push_back(surface.positions[corner]);
        }
        corner = n;
    }
    for (std::size_t i = 0; i < left.size(); i += kCorners)
        level.surface.triangles.emplace_back(left[i], left[i + 1], left[i + 2]);
    derive_normals(level.surface);
    return level;
}

}  // namespace zskel
