#pragma once

#include <vector>

#include "zskel/mesh/welded_mesh.h"

namespace zskel {

/// Mends edges with more than two triangles where it can be told what was meant. Patches are
/// triangles that hang together over edges with two. Left out are patches that hang loose from such
/// an edge and are small (fins), and patches that nobody sees from outside (walls between parts
/// that share them). What is left at an edge is paired, each patch with itself, else those with the
/// solid between them, else, where faces disagree, by the narrowest wedges; pairs get places of
/// their own, so that parts that only touch there part, and a middle of their own where what they
/// belong to hangs together at both ends.
void mend_crowded_edges(WeldedMesh& mesh, std::vector<Repair>& repairs);

}  // namespace zskel
