#pragma once

#include <span>

#include "zskel/mesh/surface.h"

namespace zskel {

/// Generalised winding number of a triangle set about `point`: the sum of signed solid angles over
/// 4 pi; 1 inside a closed outward surface, 0 outside, fractions where it is open. O(triangles).
/// @see van Oosterom and Strackee 1983 for the angle; Jacobson et al. 2013 for the number.
double winding_number(const std::vector<Vec3>& positions, std::span<const Triangle> triangles,
                      const DVec3& point);

}  // namespace zskel
