#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/skeleton/network.h"

namespace zskel {

/// A way from a cluster to one beside it.
struct Arc {
    std::uint32_t to;
    std::uint32_t connection;
};
/// The arcs of every cluster; a connection of a cluster with itself gives it two.
using Arcs = std::vector<std::vector<Arc>>;

/// @param numbers  of the connections that count.
Arcs arcs_of(std::span<const Connection> connections, std::span<const std::uint32_t> numbers,
             std::size_t clusters);

/// The connections that are left when dead ends are taken off: cycles, and what joins them.
std::vector<std::uint32_t> core_of(std::span<const Connection> connections,
                                   std::span<const std::uint32_t> numbers, std::size_t clusters);

/// Of a core one that runs along the thick middle. A tree of the shortest connections goes from
/// limb to limb along the surface: a way between two junctions of the core gives place to one that
/// is shorter, measured in inscribed radii along it, and differs from it by nothing in the solid's
/// homology; its ends may slide along the rest of the core. So there are as many cycles as before,
/// and their classes span the same.
/// @param girths  of the clusters: a ring that nothing hangs on keeps its thickest.
/// Work: n log n a way, in the clusters that are no farther than it is long.
std::vector<std::uint32_t> lay_core(const SurfaceQuery& query, std::span<const float> girths,
                                    std::span<const Connection> connections,
                                    std::span<const std::uint32_t> core);

}  // namespace zskel
