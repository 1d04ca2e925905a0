#pragma once

#include "zskel/skeleton/curve_graph.h"

namespace zskel {

/// Makes one of two junctions that a branch joins which is shorter than `merge_radii` of the
/// greater radius: the one with the greater, when the other's neighbours can be joined to it inside
/// and the cycles stay.
/// @return how many are gone.
std::size_t merge_junctions(CurveGraph& graph, const SurfaceQuery& query, double merge_radii);

}  // namespace zskel
