#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Splits a polygon into corners - 2 triangles of the same winding, appended to `triangles`.
/// Concave polygons are cut inside their outline; the plane is the one of Newell's normal. The same
/// polygon is cut the same way from whichever corner and side it is given.
/// @param positions  of all vertices; the polygon's own are looked up.
/// @param polygon    at least three vertex numbers, in order; may repeat and lie on a line.
/// @param looks_left  how often a corner may still be looked at; counts down. A polygon of n
/// corners
///     takes about n log n looks, some take n^2.
/// @return false where no proper cut exists (the outline crosses itself, or has no area), or none
/// was found with the looks that are left: then the rest is a fan.
bool triangulate(std::span<const DVec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<Triangle>& triangles, std::size_t& looks_left);

}  // namespace zskel
