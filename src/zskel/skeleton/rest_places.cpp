#include "zskel/skeleton/rest_places.h"

#include <cmath>

namespace zskel {
namespace {

constexpr float kApart = 2.0f / 3.0f;  // that places lie, in radii of their cores

}  // namespace

void RestPlaces::add(const Vec3& place, float nearest) {
    const float radius = share_ * nearest;
    if (!(radius > 0.0f) || !std::isfinite(radius) || core_about(place, kApart)) return;
    const int exponent = std::ilogb(radius) + 2;
    grids_[exponent][cell_of(DVec3(place), std::ldexp(1.0, exponent))].push_back({place, radius});
}

std::optional<Vec3> RestPlaces::find(const Vec3& point) const {
    const Core* core = core_about(point, 1.0f);
    return core != nullptr ? std::optional(core->center) : std::nullopt;
}

// The nearest within so many radii of a core, in those radii; at most 1.
const RestPlaces::Core* RestPlaces::core_about(const Vec3& point, float within) const {
    const Core* found = nullptr;
    float least = within;
    for (const auto& [exponent, grid] : grids_) {
        const double size = std::ldexp(1.0, exponent);
        // No core reaches farther than half a cell.
        const glm::i64vec3 first = cell_of(DVec3(point) - 0.5 * size, size);
        for (int corner = 0; corner < 8; ++corner) {
            const auto cores =
                grid.find(first + glm::i64vec3(corner & 1, corner >> 1 & 1, corner >> 2));
            if (cores == grid.end()) continue;
            for (const Core& core : cores->second) {
                const float away = glm::distance(point, core.center) / core.radius;
                if (away > least) continue;
                least = away;
                found = &core;
            }
        }
    }
    return found;
}

}  // namespace zskel
