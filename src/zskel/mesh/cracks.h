#pragma once

#include <vector>

#include "zskel/mesh/welded_mesh.h"

namespace zskel {

/// Closes cracks along boundary edges: places on them that lie within `tolerance` of each other
/// become one, but never farther apart than a quarter of the edges there; and where a place lies
/// as near to the inside of such an edge, the edge's triangle is split there (a T-junction).
/// @param tolerance  model units. O(n log n) where boundary edges are of like lengths.
void close_cracks(WeldedMesh& mesh, double tolerance, std::vector<Repair>& repairs);

}  // namespace zskel
