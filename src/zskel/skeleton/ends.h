#pragma once

#include "zskel/skeleton/refine.h"

namespace zskel {

/// Every end goes on straight ahead to near the surface, or to near the farthest of its own surface
/// when that lies farther ahead.
/// @param seed_points  where every seed's vertex is on the surface.
/// @return how many got longer.
std::size_t extend_ends(CurveGraph& graph, std::span<const Vec3> seed_points,
                        const SurfaceQuery& query, const RefineOptions& options);

/// The last stretch of every branch with an end goes straight from where the section is whole to
/// the middle of what lies ahead: a flat end is left through its middle, not at a corner, and an
/// end that bends is followed.
void aim_ends(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options);

}  // namespace zskel
