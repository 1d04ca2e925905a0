#pragma once

#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// How many triangles pass through another one. Pairs that only touch, lie in one plane, or share
/// an edge do not count; signs are those of double arithmetic.
/// @param triangles  welded: neighbours have the same corners.
std::size_t count_crossing_triangles(const std::vector<DVec3>& positions,
                                     const std::vector<Triangle>& triangles);

}  // namespace zskel
