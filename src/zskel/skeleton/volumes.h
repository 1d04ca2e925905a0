#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// The share of a closed solid that belongs to each node (the paper's node weight): what the
/// surface sweeps when each of its vertices goes straight to its node, a third of every triangle's
/// sweep to each corner's node. World units; shares that come out negative, where a vertex looks
/// past its node, count as 0; the sum is the solid's volume.
/// @param vertex_node  the node of every vertex of the surface.
std::vector<double> node_volumes(const Surface& surface, std::span<const std::uint32_t> vertex_node,
                                 std::span<const Vec3> nodes);

}  // namespace zskel
