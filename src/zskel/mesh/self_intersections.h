#pragma once

#include <cstdint>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// The numbers of the triangles that pass through another one, ascending. Pairs that only touch,
/// lie in one plane, or share an edge do not count; signs are those of double arithmetic.
/// @param triangles  welded: neighbours have the same corners.
std::vector<std::uint32_t> crossing_triangles(const std::vector<DVec3>& positions,
                                              const std::vector<Triangle>& triangles);

}  // namespace zskel
