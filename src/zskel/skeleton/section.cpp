#include "zskel/skeleton/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "zskel/core/across.h"

namespace zskel {
namespace {

constexpr std::size_t kPairs = 8;
constexpr double kMostMedians = 3.0;

}  // namespace

Vec3 step_to_section_centre(const SurfaceQuery& query, const Vec3& point, const Vec3& tangent) {
    const DVec3 along(tangent);
    const Across section(along);
    const auto& [across, up] = section;
    std::array<DVec3, kPairs> directions;
    std::array<Vec3, 2 * kPairs> rays;
    for (std::size_t i = 0; i < kPairs; ++i) {
        const double angle = std::numbers::pi * static_cast<double>(i) / kPairs;
        directions[i] = section.at(angle);
        rays[i] = Vec3(directions[i]);
        rays[i + kPairs] = -rays[i];
    }
    std::array<float, 2 * kPairs> free_ways{};
    query.free_ways(point, rays, free_ways);
    std::array<double, 2 * kPairs> ways{};
    std::copy(free_ways.begin(), free_ways.end(), ways.begin());
    std::array<double, 2 * kPairs> sorted = ways;
    std::nth_element(sorted.begin(), sorted.begin() + kPairs, sorted.end());
    const double limit = kMostMedians * sorted[kPairs];
    // A move m changes (u - v) / (u + v) by -2 m.d / (u + v): normal equations in the plane.
    double aa = 0.0, ab = 0.0, bb = 0.0, ra = 0.0, rb = 0.0;
    for (std::size_t i = 0; i < kPairs; ++i) {
        const double longer = std::max(ways[i], ways[i + kPairs]);
        if (longer >= static_cast<double>(SurfaceQuery::kFarthest)) continue;
        const double u = std::min(ways[i], limit);
        const double v = std::min(ways[i + kPairs], limit);
        if (!(u + v > 0.0)) return Vec3(0.0f);
        const double a = 2.0 * glm::dot(directions[i], across) / (u + v);
        const double b = 2.0 * glm::dot(directions[i], up) / (u + v);
        const double rest = (u - v) / (u + v);
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ra += a * rest;
        rb += b * rest;
    }
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-9 * aa * bb)) return Vec3(0.0f);
    return Vec3(across * ((bb * ra - ab * rb) / determinant) +
                up * ((aa * rb - ab * ra) / determinant));
}

float section_half_width(const SurfaceQuery& query, const Vec3& point, const Vec3& tangent) {
    const Vec3 along = glm::cross(tangent, query.nearest(point).point - point);
    if (!(glm::length(along) > 0.0f)) return 0.0f;
    const std::array<Vec3, 2> rays{glm::normalize(along), -glm::normalize(along)};
    std::array<float, 2> ways{};
    query.free_ways(point, rays, ways);
    const bool leads_out = std::max(ways[0], ways[1]) >= SurfaceQuery::kFarthest;
    return leads_out ? 0.0f : 0.5f * (ways[0] + ways[1]);
}

}  // namespace zskel
