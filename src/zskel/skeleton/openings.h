#pragma once

#include "zskel/mesh/solid.h"
#include "zskel/skeleton/method.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// Lets the skeleton of a solid with caps know where it is open: radii become those of its walls
/// alone, and the end nearest to an opening that is as wide as the branch there, by half, runs to
/// the middle of the opening's rim and is listed in `open_ends`.
/// @param query  of the solid's surface, caps and all.
void run_to_openings(const Solid& solid, const SurfaceQuery& query, SolidSkeleton& skeleton);

}  // namespace zskel
