#pragma once

#include <vector>

#include "zskel/skeleton/graph.h"

namespace zskel {

/// A surface to look at, in model space.
struct TubeSurface {
    std::vector<DVec3> positions;
    std::vector<std::uint32_t> node;  ///< that each vertex lies around, at its radius' distance
    std::vector<Triangle> triangles;  ///< outward
};

/// A tube for each branch, closed by half balls at both ends, so that balls cover the junctions;
/// rings are closed in themselves, and lone nodes are balls. Each piece is closed and oriented;
/// pieces that meet at a junction reach into each other.
/// @param sides  vertices around a tube, 4 or more.
TubeSurface tube_surface(const SkeletonGraph& graph, std::uint32_t sides = 16);

}  // namespace zskel
