#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/mesh.h"
#include "zskel/skeleton/graph.h"
#include "zskel/visibility/backend.h"

namespace zskel {

/// How far a node of a skeleton sees, in every texel of a cube map (`cube_map.h`); model space.
struct NodeMap {
    DVec3 eye{0.0};
    std::uint32_t solid = 0;
    std::vector<float> distance;  ///< 6 n^2, along the texels' rays; infinite where nothing is hit
};

/// The visibility maps of a skeleton's nodes.
struct VisibilityMaps {
    int face_px = 0;
    std::vector<NodeMap> nodes;
};

/// Looks round from every node of a skeleton, each in its own solid.
/// @param graph    of that mesh.
/// @param backend  must sample cube maps; its texels are the maps'.
/// @throws InputError when the mesh is not the graph's, UsageError for a backend of rays that are
/// no cube map, GlError when the backend fails.
VisibilityMaps look_from_nodes(const Mesh& mesh, const SkeletonGraph& graph, Backend& backend);

}  // namespace zskel
