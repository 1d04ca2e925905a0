#pragma once

#include "zskel/mesh/solid.h"
#include "zskel/skeleton/method.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// Lets the skeleton of a solid with caps know where it is open: radii become those of its walls
/// alone, and to each opening that is an end (see Opening) and no narrower than half the branch
/// there the nearest end of a branch runs on, or else a branch from the nearest node that sees it:
/// to the middle of its rim, a node listed in `open_ends`.
/// @param query  of the solid's surface, caps and all.
void run_to_openings(const Solid& solid, const SurfaceQuery& query, SolidSkeleton& skeleton);

}  // namespace zskel
