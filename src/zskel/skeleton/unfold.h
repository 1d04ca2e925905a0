#pragma once

#include "zskel/skeleton/refine.h"

namespace zskel {

/// A branch that goes out into a limb and back beside itself becomes a limb with an end, and a
/// junction where the ways part; an end that hooks back beside its own branch is given up. Cycles
/// stay, and no segment that was free is left unfree.
/// @return how many ways were laid into another.
std::size_t unfold_branches(CurveGraph& graph, const SurfaceQuery& query,
                            const RefineOptions& options);

}  // namespace zskel
