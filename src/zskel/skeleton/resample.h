#pragma once

#include "zskel/skeleton/refine.h"

namespace zskel {

/// How far apart nodes are along a branch.
enum class Spacing {
    ByRadius,  ///< the local radius, between the bounds of the options
    Even,      ///< all alike, at most `even_spacing_world`
};

/// New nodes along every branch; the seeds go to the nearest of them. Corners stay where the way
/// past them is not free.
/// @param seed_points  where every seed's vertex is on the surface.
/// @throws UsageError when even spacing asks for more than ten million nodes.
void resample_branches(CurveGraph& graph, std::span<const Vec3> seed_points,
                       const SurfaceQuery& query, const RefineOptions& options, Spacing spacing);

}  // namespace zskel
