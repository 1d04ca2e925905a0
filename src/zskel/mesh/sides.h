#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// A side of a triangle, from one of its corners to the next.
struct Side {
    glm::uvec2 edge;  ///< lower vertex first
    std::uint32_t triangle;
    std::uint8_t corner;  ///< that it runs from
    bool forward;         ///< that corner is the lower vertex
};

/// All sides of `triangles`, each of three different vertices below `vertices`, by edge, then by
/// triangle. O(n) where no vertex has many triangles.
std::vector<Side> sorted_sides(std::span<const Triangle> triangles, std::size_t vertices);

/// Calls `visit(first, last)` for each run of sides that share an edge.
template <typename Visit>
void for_each_edge(std::span<const Side> sides, const Visit& visit) {
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t last = first + 1;
        while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
        visit(first, last);
        first = last;
    }
}

}  // namespace zskel
