#include "zskel/skeleton/girth.h"

#include <algorithm>

#include "zskel/core/parallel.h"
#include "zskel/visibility/directions.h"

namespace zskel {
namespace {

constexpr int kDirections = 64;
constexpr float kMostRadii = 3.0f;
constexpr float kLeastCosine = 0.7f;  // of the cone into the depth

float middle_of(std::vector<float>& ways) {
    const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
    std::nth_element(ways.begin(), middle, ways.end());
    return *middle;
}

}  // namespace

std::vector<float> girths_at(const SurfaceQuery& query, std::span<const Vec3> points) {
    const Directions directions = radial_directions(kDirections);
    std::vector<float> out(points.size());
    parallel_for(points.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float longest = kMostRadii * query.nearest(points[i]).distance;
            std::vector<float> ways;
            for (const DVec3& direction : directions.unit) {
                ways.push_back(query.free_way(points[i], Vec3(direction), longest));
            }
            out[i] = middle_of(ways);
        }
    });
    return out;
}

std::vector<float> depths_under(const SurfaceQuery& query, std::span<const Vec3> inside,
                                std::span<const Vec3> normals) {
    const Directions directions = radial_directions(4 * kDirections);
    std::vector<float> out(inside.size());
    parallel_for(inside.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::vector<float> ways;
            for (const DVec3& direction : directions.unit) {
                const Vec3 way(direction);
                if (glm::dot(way, -normals[i]) >= kLeastCosine)
                    ways.push_back(query.free_way(inside[i], way));
            }
            out[i] = ways.empty() ? kInfinity : 0.5f * middle_of(ways);
        }
    });
    return out;
}

}  // namespace zskel
