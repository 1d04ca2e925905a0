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

Arcs arcs_of(std::span<const Connection> connections, std::size_t clusters);

/// @param numbers  of the connections that count.
Arcs arcs_of(std::span<const Connection> connections, std::span<const std::uint32_t> numbers,
             std::size_t clusters);

/// The connections that are left when dead ends are taken off: cycles, and what joins them.
std::vector<std::uint32_t> core_of(std::span<const Connection> connections,
                                   std::span<const std::uint32_t> numbers, std::size_t clusters);

struct LaidCore {
    std::vector<std::uint32_t> connections;
    bool is_complete = true;  ///< false when ways were left as they were, for the work
};

/// Of a core one that runs along the thick middle. A tree of the shortest connections goes from
/// limb to limb along the surface: a way between two junctions of the core gives place to one that
/// is shorter, measured in inscribed radii along it, and differs from it by nothing in the solid's
/// homology; its ends may slide along the rest of the core. There are as many cycles as before, and
/// their classes span the same, as far as `Connection::sum` tells classes apart. Connections of a
/// cluster with itself may give place, but are in no new way.
/// @param girths  of the clusters: a ring that nothing hangs on is laid from its thickest.
/// Work: a bounded number of places, each a cluster and a sum, and for each way that gives place
/// once through the network.
LaidCore lay_core(const SurfaceQuery& query, std::span<const float> girths,
                  std::span<const Connection> connections, std::span<const std::uint32_t> core);

}  // namespace zskel
