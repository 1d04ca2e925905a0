#pragma once

#include <cstdint>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// A curve skeleton, in model space.
struct SkeletonGraph {
    struct Node {
        DVec3 position{0.0};
        double radius = 0.0;      ///< inscribed: distance to the nearest surface point
        std::uint32_t solid = 0;  ///< the solid it belongs to
    };
    struct Edge {
        std::uint32_t source = 0;  ///< lower node number
        std::uint32_t target = 0;
    };
    std::vector<Node> nodes;
    std::vector<Edge> edges;                 ///< each once, sorted
    std::vector<std::uint32_t> vertex_node;  ///< of every input vertex; kNone where it has no face
};

/// Number of edges at each node: 1 at ends, 3 and more at junctions.
std::vector<std::uint32_t> node_degrees(const SkeletonGraph& graph);

/// Connected components of the graph, and independent cycles: edges - nodes + components.
struct GraphTopology {
    std::size_t components = 0;
    std::size_t cycles = 0;
};
GraphTopology graph_topology(const SkeletonGraph& graph);

}  // namespace zskel
