#pragma once

#include "zskel/skeleton/refine.h"

namespace zskel {

/// Sweeps over all branches that move every node to the centre of its section, every junction to
/// where the solid is thickest near it, and smooth between neighbours; ends stay. No move leaves
/// the solid.
void centre_branches(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options);

}  // namespace zskel
