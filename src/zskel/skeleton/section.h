#pragma once

#include "zskel/visibility/surface_query.h"

namespace zskel {

/// The move, in the plane across `tangent`, to where the free ways to both sides balance: the least
/// squares of (u - v) / (u + v) over pairs of opposite directions with free ways u and v, ways
/// limited to three times their median so that an opening to a side limb does not pull; pairs that
/// lead out through an opening of the surface are left out. Zero at the centre of every centrally
/// symmetric section, flat or round. World units.
/// @param tangent  unit vector along the branch.
Vec3 step_to_section_centre(const SurfaceQuery& query, const Vec3& point, const Vec3& tangent);

/// Half the chord across `tangent` that runs along the nearest wall: of a sheet's section half the
/// width. 0 where it leads out through an opening.
float section_half_width(const SurfaceQuery& query, const Vec3& point, const Vec3& tangent);

}  // namespace zskel
