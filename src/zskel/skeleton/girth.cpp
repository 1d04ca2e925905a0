#include "zskel/skeleton/girth.h"

#include <algorithm>
#include <iterator>

#include "zskel/core/parallel.h"
#include "zskel/visibility/directions.h"

namespace zskel {
namespace {

constexpr int kDirections = 64;
constexpr float kMostRadii = 3.0f;
constexpr float kLeastCosine = 0.7f;  // of the cone into the depth

float middle_of(std::span<float> ways) {
    const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
    std::nth_element(ways.begin(), middle, ways.end());
    return *middle;
}

std::vector<Vec3> directions_round(int count) {
    const Directions directions = radial_directions(count);
    return {directions.unit.begin(), directions.unit.end()};
}

}  // namespace

std::vector<float> girths_at(const SurfaceQuery& query, std::span<const Vec3> points) {
    const std::vector<Vec3> directions = directions_round(kDirections);
    std::vector<float> out(points.size());
    parallel_for(points.size(), 8, [&](std::size_t begin, std::size_t end) {
        std::vector<float> ways(directions.size());
        for (std::size_t i = begin; i < end; ++i) {
            query.free_ways(points[i], directions, ways);
            const float shortest = *std::min_element(ways.begin(), ways.end());
            const float longest = kMostRadii * query.nearest(points[i], shortest).distance;
            out[i] = std::min(middle_of(ways), longest);
        }
    });
    return out;
}

std::vector<float> depths_under(const SurfaceQuery& query, std::span<const Vec3> inside,
                                std::span<const Vec3> normals) {
    const std::vector<Vec3> directions = directions_round(2 * kDirections);
    std::vector<float> out(inside.size());
    parallel_for(inside.size(), 8, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> down;
        std::vector<float> ways;
        for (std::size_t i = begin; i < end; ++i) {
            down.clear();
            std::copy_if(directions.begin(), directions.end(), std::back_inserter(down),
                         [&](const Vec3& d) { return glm::dot(d, -normals[i]) >= kLeastCosine; });
            ways.resize(down.size());
            query.free_ways(inside[i], down, ways);
            out[i] = ways.empty() ? kInfinity : 0.5f * middle_of(ways);
        }
    });
    return out;
}

}  // namespace zskel
