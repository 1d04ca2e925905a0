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
    bool is_forward;      ///< that corner is the lower vertex

    /// The corners at its ends, as 3 x triangle + place.
    std::uint32_t low_corner() const { return is_forward ? from() : to(); }
    std::uint32_t high_corner() const { return is_forward ? to() : from(); }

  private:
    std::uint32_t from() const { return 3 * triangle + corner; }
    std::uint32_t to() const { return 3 * triangle + (corner + 1u) % 3u; }
};

/// All sides of `triangles`, whose vertices are below `vertices`, by edge, then by triangle; those
/// of triangles that repeat a corner are left out. O(n) where no vertex has many triangles.
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
