#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Places along an edge of a LevelSetBlock.
inline constexpr int kLevelSetBlock = 8;

/// A function's values at 8 x 8 x 8 places of a lattice: below 0 is inside.
struct LevelSetBlock {
    glm::ivec3 at{0};           ///< in blocks; its first place is 8 times that
    std::vector<float> values;  ///< one for all, or one a place, z fastest
};

/// A surface in lattice units: closed wherever the blocks go on to where the sign no longer
/// changes, manifold whatever the values are, counter-clockwise seen from outside.
struct LevelSetMesh {
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;
};

/// Takes out the connected parts of which this is true, with their vertices; returns how many.
std::size_t drop_parts(LevelSetMesh& mesh,
                       const std::function<bool(std::span<const Triangle> part)>& is_dropped);

/// The zero surface by marching tetrahedra. Cells of which a corner is in no block are left out.
LevelSetMesh mesh_level_set(std::span<const LevelSetBlock> blocks);

}  // namespace zskel
