#include "zskel/skeleton/path.h"

#include <algorithm>
#include <cstdint>

namespace zskel {

float length_of(std::span<const Vec3> path) {
    float sum = 0.0f;
    for (std::size_t i = 1; i < path.size(); ++i) sum += glm::distance(path[i - 1], path[i]);
    return sum;
}

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
    const Vec3 way = b - a;
    const float length2 = glm::dot(way, way);
    const float share = length2 > 0.0f ? glm::dot(point - a, way) / length2 : 0.0f;
    return a + way * std::clamp(share, 0.0f, 1.0f);
}

float distance_to(std::span<const Vec3> path, const Vec3& point) {
    float least = kInfinity;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Vec3 nearest = nearest_on_segment(path[i - 1], path[i], point);
        least = std::min(least, glm::distance(point, nearest));
    }
    return least;
}

bool is_free(std::span<const Vec3> path, const SurfaceQuery& query) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (!query.sees(path[i - 1], path[i])) return false;
    }
    return true;
}

std::vector<Vec3> pull_tight(const std::vector<Vec3>& path, const SurfaceQuery& query,
                             const HandleClasses& handles) {
    std::vector<std::uint64_t> sums{0};
    for (std::size_t i = 1; i < path.size(); ++i)
        sums.push_back(sums.back() + handles.segment_sum(path[i - 1], path[i]));
    const auto can_skip = [&](std::size_t from, std::size_t to) {
        return query.sees(path[from], path[to]) &&
               handles.segment_sum(path[from], path[to]) == sums[to] - sums[from];
    };
    std::vector<Vec3> out{path.front()};
    std::size_t at = 0;
    while (at + 1 < path.size()) {
        std::size_t next = path.size() - 1;
        while (next > at + 1 && !can_skip(at, next)) --next;
        out.push_back(path[next]);
        at = next;
    }
    return out;
}

}  // namespace zskel
