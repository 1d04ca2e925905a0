#include "zskel/mesh/sides.h"

#include <algorithm>
#include <tuple>

#include "zskel/core/bucket_sort.h"

namespace zskel {

std::vector<Side> sorted_sides(std::span<const Triangle> triangles, std::size_t vertices) {
    const auto for_each_side = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            const Triangle& corners = triangles[t];
            if (corners.x == corners.y || corners.y == corners.z || corners.z == corners.x)
                continue;
            for (std::uint8_t k = 0; k < 3; ++k) {
                const std::uint32_t a = corners[k];
                const std::uint32_t b = corners[(k + 1) % 3];
                visit({{std::min(a, b), std::max(a, b)}, t, k, a < b});
            }
        }
    };
    return bucket_sorted<Side>(
        for_each_side, vertices, [](const Side& s) { return s.edge.x; },
        [](const Side& l, const Side& r) {
            return std::tie(l.edge.y, l.triangle) < std::tie(r.edge.y, r.triangle);
        });
}

}  // namespace zskel
