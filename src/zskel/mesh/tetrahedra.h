#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <utility>

namespace zskel {

/// A unit cell cut in six around its diagonal, all turning the same way (Kuhn 1960).
inline constexpr std::array<std::array<glm::ivec3, 4>, 6> kCellTetrahedra = {{
    {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}},
    {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}}},
    {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}},
    {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}}},
    {{{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}}},
    {{{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {1, 1, 1}}},
}};

/// An edge of a tetrahedron by its corners, 0 to 3.
using TetrahedronEdge = std::pair<int, int>;

/// What parts a tetrahedron's corners that are inside from those that are not (Doi and Koide 1991):
/// nothing, a triangle or a quad, told as the edges it cuts, counter-clockwise seen from outside.
/// @param inside  a bit for each corner.
template <typename Take>
void cut_tetrahedron(int inside, const Take& take) {
    // Even permutations, so that the polygon keeps the tetrahedron's turn.
    static constexpr int kEven[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    static constexpr int kPairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                         {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
    for (const auto& v : kEven) {
        std::array<TetrahedronEdge, 3> edges{{{v[0], v[1]}, {v[0], v[2]}, {v[0], v[3]}}};
        if (inside == (15 ^ (1 << v[0]))) std::swap(edges[1], edges[2]);
        if (inside == 1 << v[0] || inside == (15 ^ (1 << v[0])))
            take(std::span<const TetrahedronEdge>(edges));
    }
    for (const auto& v : kPairs) {
        const std::array<TetrahedronEdge, 4> edges{
            {{v[0], v[2]}, {v[0], v[3]}, {v[1], v[3]}, {v[1], v[2]}}};
        if (inside == (1 << v[0] | 1 << v[1])) take(std::span<const TetrahedronEdge>(edges));
    }
}

}  // namespace zskel
