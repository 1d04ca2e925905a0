#pragma once

#include <span>
#include <vector>

#include "zskel/visibility/surface_query.h"

namespace zskel {

/// How thick the body is about a point inside: the median of the free way in even directions, at
/// most three times the inscribed radius. The radius at the centre of a ball, 1.15 of it on the
/// axis of a tube; where the section is flat more than the inscribed radius, so that the edges of a
/// flat limb do not count as limbs of their own.
std::vector<float> girths_at(const SurfaceQuery& query, std::span<const Vec3> points);

/// Half the local thickness under places on the surface: the median free way into a cone about the
/// inward normal, halved; infinite where there is no normal.
/// @param inside   a point just inside each place.
/// @param normals  outward, unit.
/// @see Shapira et al. 2008 (shape diameter function)
std::vector<float> depths_under(const SurfaceQuery& query, std::span<const Vec3> inside,
                                std::span<const Vec3> normals);

}  // namespace zskel
