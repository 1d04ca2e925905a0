#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "zskel/core/aligned.h"
#include "zskel/mesh/surface.h"

namespace zskel {

/// Triangles, or boxes, that a widest register takes at once.
inline constexpr std::size_t kBlock = 16;

/// Sixteen triangles, every coordinate an array of its own.
struct TriangleBlock {
    std::array<std::array<float, kBlock>, 9> corner;  ///< x y z of the first, second, third
    std::array<std::array<float, kBlock>, 3> normal;  ///< unit; zero for padding
    std::array<std::uint32_t, kBlock> id;             ///< in the surface
};

/// The boxes of sixteen clusters.
struct BoxBlock {
    std::array<std::array<float, kBlock>, 3> low;
    std::array<std::array<float, kBlock>, 3> high;
};

/// A surface's triangles in clusters that lie close together: what an eye cannot see is left out by
/// the cluster. World space.
struct TriangleClusters {
    AlignedVector<TriangleBlock> triangles;
    AlignedVector<BoxBlock> boxes;           ///< padded with boxes at infinity
    std::vector<std::uint32_t> first_block;  ///< of every cluster, and one past the last

    std::size_t size() const { return first_block.size() - 1; }
};

/// Halves the triangles by place until clusters are small: meshoptimizer's meshlets measure the
/// same, within 2 %, and lose the triangles' numbers. O(n log n).
/// @param most  triangles a cluster, at most; a multiple of kBlock.
TriangleClusters cluster_triangles(const Surface& surface, std::size_t most);

}  // namespace zskel
