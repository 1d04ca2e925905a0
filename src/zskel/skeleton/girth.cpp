#include "zskel/skeleton/girth.h"

#include <algorithm>

#include "zskel/core/parallel.h"
#include "zskel/visibility/directions.h"

namespace zskel {
namespace {

constexpr int kDirections = 64;
constexpr float kMostRadii = 3.0f;

}  // namespace

std::vector<float> girths_at(const SurfaceQuery& query, std::span<const Vec3> points) {
    const Directions directions = radial_directions(kDirections);
    std::vector<float> out(points.size());
    parallel_for(points.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float longest = kMostRadii * query.nearest(points[i]).distance;
            std::vector<float> ways;
            for (const DVec3& direction : directions.unit) {
                const auto hit = query.first_hit(points[i], points[i] + Vec3(direction) * longest);
                ways.push_back(hit ? hit->fraction * longest : longest);
            }
            const auto middle = ways.begin() + kDirections / 2;
            std::nth_element(ways.begin(), middle, ways.end());
            out[i] = *middle;
        }
    });
    return out;
}

}  // namespace zskel
