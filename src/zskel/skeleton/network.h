#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/mesh/homology.h"
#include "zskel/skeleton/surface_walks.h"

namespace zskel {

/// Where clusters meet on the surface, and how they are joined inside.
struct Connection {
    std::uint32_t a =
        0;  ///< clusters, a <= b; both are one where its own patch goes round a handle
    std::uint32_t b = 0;
    std::uint32_t vertex_a = 0;  ///< a mesh edge from a's patch to b's
    std::uint32_t vertex_b = 0;
    std::vector<Vec3> path;  ///< from a's centre to b's, inside
    float length = 0.0f;
    bool is_inside = true;  ///< false when no free way was found
    std::uint64_t sum = 0;  ///< the path's HandleClasses::segment_sum
};

/// How clusters are joined.
struct ClusterNetwork {
    std::vector<Connection> connections;  ///< all that the mesh gives, and bridges between shells
    std::vector<std::uint32_t> spanning;  ///< numbers of those in the tree and of its cycles
    std::vector<std::uint32_t> core;      ///< numbers of those in cycles, and of what joins these;
                                          ///< laid anew, so not all of them are in `spanning`
    bool is_core_laid = true;             ///< false when cycles were left as they were found
    bool has_all_cycles = true;  ///< as many as handles; if not, some could not be laid inside
};

/// A tree of the shortest connections over the clusters of each part, and as many more as the solid
/// has handles: shortest cycles first, each only when its class is independent of those before, and
/// the whole a basis over the integers. Connections through small handles that are cut come last.
/// Then the cycles are laid along the thick middle, see `lay_core`.
/// @param handles  empty on open or broken surfaces: then it is the forest alone.
/// Work: a path to lay for each class of connection between two clusters, and for each cycle looked
/// at the non-zero numbers of the classes before it.
ClusterNetwork connect_network(const ClusterContext& context, const HandleClasses& handles);

}  // namespace zskel
