#pragma once

#include <span>
#include <vector>

#include "zskel/mesh/homology.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// Length of a chain of points.
float length_of(std::span<const Vec3> path);

/// The point of a segment that is nearest to another one.
Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& point);

/// From a point to the nearest point of a chain of points; infinite when that has no segment.
float distance_to(std::span<const Vec3> path, const Vec3& point);

/// Whether every segment of a path is free.
bool is_free(std::span<const Vec3> path, const SurfaceQuery& query);

/// The path, straightened: points are left out while the segment past them is free and goes the
/// same way round all handles.
std::vector<Vec3> pull_tight(const std::vector<Vec3>& path, const SurfaceQuery& query,
                             const HandleClasses& handles = {});

}  // namespace zskel
