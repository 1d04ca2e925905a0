#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "zskel/mesh/homology.h"
#include "zskel/skeleton/cluster.h"
#include "zskel/skeleton/settle.h"
#include "zskel/skeleton/shortcuts.h"
#include "zskel/skeleton/spread.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// Where clusters meet on the surface, and how they are joined inside.
struct Connection {
    std::uint32_t a = 0;  ///< clusters, a < b
    std::uint32_t b = 0;
    std::uint32_t vertex_a = 0;  ///< a mesh edge from a's patch to b's
    std::uint32_t vertex_b = 0;
    std::vector<Vec3> path;  ///< from a's centre to b's, inside
    float length = 0.0f;
    bool is_inside = true;  ///< false when no free way was found
};

/// What the joining of clusters needs to look at. All of one solid.
struct ClusterContext {
    const Surface& surface;
    const SurfaceQuery& query;
    const SeedSpread& spread;
    std::span<const SettledSeed> settled;  ///< with paths
    std::span<const Vec3> inner;           ///< a point inside near every vertex
    std::span<const glm::uvec2> links;     ///< pairs of seeds whose patches meet
    std::span<const Shortcut> shortcuts;
    const Clusters& clusters;  ///< of seeds; centres are end points of seeds
};

/// A tree of the shortest connections over the clusters of each part, and as many more as the solid
/// has handles: shortest cycles first, each only when its class is independent of those before, and
/// the whole a basis over the integers. Without `handles` (open or broken surfaces) it is the
/// forest alone.
struct ClusterNetwork {
    std::vector<Connection> connections;  ///< all that the mesh gives, and bridges between shells
    std::vector<std::uint32_t> spanning;  ///< numbers of those in the tree and of its cycles
    bool has_all_cycles = true;           ///< false when some cluster has swallowed a handle
};
ClusterNetwork connect_network(const ClusterContext& context,
                               const std::optional<HandleClasses>& handles);

/// The way between two points, straightened: points of `path` are left out while the segment past
/// them is free.
std::vector<Vec3> pull_tight(const std::vector<Vec3>& path, const SurfaceQuery& query);

/// Whether every segment of a path is free.
bool is_free(std::span<const Vec3> path, const SurfaceQuery& query);

}  // namespace zskel
