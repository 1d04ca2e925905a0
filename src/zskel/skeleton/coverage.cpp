#include "zskel/skeleton/coverage.h"

#include <algorithm>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/skeleton/path.h"

namespace zskel {

Coverage::Coverage(const SurfaceQuery& query, std::vector<Vec3> places, std::vector<Vec3> inside)
    : query_(query),
      places_(std::move(places)),
      inside_(std::move(inside)),
      beyond_(places_.size(), kInfinity),
      distance_(places_.size(), kInfinity) {}

void Coverage::add(std::span<const Vec3> path, float first_radius, float last_radius) {
    const float length = length_of(path);
    const auto radius_at = [&](float along) {
        return glm::mix(first_radius, last_radius, length > 0.0f ? along / length : 0.0f);
    };
    parallel_for(places_.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t place = begin; place < end; ++place) {
            float passed = 0.0f;
            for (std::size_t i = 1; i < path.size(); ++i) {
                const float piece = glm::distance(path[i - 1], path[i]);
                add_segment(place, path[i - 1], path[i], radius_at(passed),
                            radius_at(passed + piece));
                passed += piece;
            }
        }
    });
}

void Coverage::add_segment(std::size_t i, const Vec3& a, const Vec3& b, float radius_a,
                           float radius_b) {
    const Vec3 along = b - a;
    const float square = glm::dot(along, along);
    const float part = square > 0.0f ? glm::dot(places_[i] - a, along) / square : 0.0f;
    const float share = glm::clamp(part, 0.0f, 1.0f);
    const Vec3 center = a + along * share;
    const float distance = glm::distance(places_[i], center);
    const float beyond = distance - glm::mix(radius_a, radius_b, share);
    if (beyond >= beyond_[i] && distance >= distance_[i]) return;
    if (!query_.sees(center, inside_[i])) return;
    beyond_[i] = std::min(beyond_[i], beyond);
    distance_[i] = std::min(distance_[i], distance);
}

}  // namespace zskel
