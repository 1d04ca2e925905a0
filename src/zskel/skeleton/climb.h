#pragma once

#include "zskel/visibility/surface_query.h"

namespace zskel {

/// A climb along the inscribed radius.
struct Climb {
    Vec3 top{0.0f};
    float steepness = 0.0f;  ///< gain of radius to the way there, 0 to 1: little in a flat section
};

/// From `from` to the thickest place round it, no farther away than `reach` of the radius there, in
/// steps that stay inside. A pattern search, whose last steps are a 32nd of the radius; it
/// stays where it is as thick all round.
Climb climb_to_thickest(const Vec3& from, double reach, const SurfaceQuery& query);

}  // namespace zskel
