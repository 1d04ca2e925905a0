#pragma once

#include "zskel/skeleton/refine.h"

namespace zskel {

/// New nodes along every branch, as far apart as the local radius says; the seeds go to the nearest
/// of them. Corners stay where the way past them is not free.
/// @param seed_points  where every seed's vertex is on the surface.
void resample_branches(CurveGraph& graph, std::span<const Vec3> seed_points,
                       const SurfaceQuery& query, const RefineOptions& options);

}  // namespace zskel
