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

/// The boxes of sixteen blocks, or of sixteen groups of blocks.
struct BoxBlock {
    std::array<std::array<float, kBlock>, 3> low;
    std::array<std::array<float, kBlock>, 3> high;
};

/// A surface's triangles in blocks that lie close together, and these in groups of up to sixteen:
/// what an eye cannot see is left out by the group, then by the block. World space.
struct TriangleClusters {
    AlignedVector<TriangleBlock> triangles;
    AlignedVector<BoxBlock> block_boxes;     ///< one for each group
    AlignedVector<BoxBlock> group_boxes;     ///< one for sixteen groups
    std::vector<std::uint32_t> first_block;  ///< of every group, and one past the last
};

/// Halves the triangles by place until they fill single blocks. O(n log n).
/// (meshoptimizer's meshlets as clusters measured the same, within 2 %, and lose the triangles'
/// numbers.)
TriangleClusters cluster_triangles(const Surface& surface);

/// Whether the box of a block is nearer to `point` than `distance`.
bool is_near(const TriangleClusters& clusters, const Vec3& point, float distance);

}  // namespace zskel
