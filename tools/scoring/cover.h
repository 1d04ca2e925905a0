#pragma once

#include <vector>

#include "scoring/sides.h"
#include "scoring/subject.h"

namespace zskel::scoring {

/// A point of the surface and the unit direction into the material there.
struct SurfacePoint {
    DVec3 position{0.0};
    DVec3 inward{0.0};
};

/// Points spread evenly by area, the same ones at every call.
std::vector<SurfacePoint> spread_points(const Surface& surface, std::size_t count);

/// For each surface point its distance to the skeleton over half the local thickness: the median
/// length of 24 rays in a cone of 45 degrees round the inward normal, halved. 1 on a tube round its
/// axis, large on a limb that the skeleton does not enter. Points where no ray hits are left out.
std::vector<double> coverage(const Subject& subject, const SkeletonGraph& graph,
                             const std::vector<SurfacePoint>& points);

/// For each surface point its distance, in diagonals, to the union of the balls along the skeleton
/// that touch the surface from within; 0 inside a ball.
std::vector<double> reconstruction_gaps(const Subject& subject, const SkeletonGraph& graph,
                                        const CurveSides& sides,
                                        const std::vector<SurfacePoint>& points);

}  // namespace zskel::scoring
