#pragma once

#include "zskel/skeleton/refine.h"

namespace zskel {

/// Two branches that leave a junction side by side along one axis become one as far as they do so:
/// where a limb leaves its body does not hang on which of the body's nodes it was first joined to.
/// One that comes by the next junction is joined there first. Junctions move outwards; cycles and
/// ends stay, and no segment leaves the solid.
/// @return how often two became one.
std::size_t zip_branches(CurveGraph& graph, const SurfaceQuery& query,
                         const RefineOptions& options);

}  // namespace zskel
