#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/mesh/surface.h"
#include "zskel/skeleton/branches.h"

namespace zskel {

/// The node of every vertex, so that the vertices of a node are one connected patch of the surface.
/// From the node that a vertex is given, the skeleton is walked to where no neighbour is nearer: so
/// a vertex stays with its limb. Of a node's patches only the largest stays; the others go to the
/// neighbour along the surface that is nearest. Nodes may be left without a vertex.
/// @param near  a node of the right limb for every vertex.
std::vector<std::uint32_t> assign_patches(const Surface& surface, std::span<const Vec3> nodes,
                                          const NodeLinks& links,
                                          std::span<const std::uint32_t> near);

}  // namespace zskel
