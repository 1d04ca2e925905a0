#pragma once

#include <vector>

#include "zskel/mesh/sides.h"
#include "zskel/mesh/welded_mesh.h"

namespace zskel {

/// How triangles hang together once they are oriented.
struct Orientation {
    std::vector<std::uint32_t> component;  ///< of every triangle: parts joined by edges
    std::uint32_t component_count = 0;
    std::vector<bool> component_closed;  ///< every edge has exactly two triangles
    std::vector<bool> component_sheet;   ///< open, and too thin to hold anything if it were capped
    std::vector<bool> component_orientable;
    std::vector<glm::uvec2> edges;  ///< each once, lower place first, sorted
    bool fans_are_whole = false;    ///< the triangles at every place hang together over edges
    std::size_t open_edges = 0;     ///< with one triangle
    std::size_t crowded_edges = 0;  ///< with more than two
};

/// Joins neighbours over every edge into components, turns triangles that disagree with the rest,
/// and whole components whose signed volume is negative.
/// @param sides  of the mesh; let go of as soon as they are not needed.
Orientation orient(WeldedMesh& mesh, std::vector<Side> sides, std::vector<Repair>& repairs);

}  // namespace zskel
