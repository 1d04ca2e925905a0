#pragma once

#include <cstdint>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/skeleton/branches.h"

namespace zskel {

/// A curve skeleton, in model space.
struct SkeletonGraph {
    struct Node {
        DVec3 position{0.0};
        double radius = 0.0;       ///< inscribed: distance to the nearest surface point
        std::uint32_t solid = 0;   ///< the solid it belongs to
        double volume = 0.0;       ///< of the part of its solid nearest to it; 0 in open solids
        bool is_open_end = false;  ///< where its branch ends at an opening of the surface
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

/// The neighbours of every node, ascending.
NodeLinks node_links(const SkeletonGraph& graph);

/// A chain of nodes from an end or junction to the next, or a ring.
struct Branch {
    std::vector<std::uint32_t> nodes;  ///< in order; a ring names its first node again at the end
    bool is_ring = false;              ///< without any junction on it
    std::uint32_t start_degree = 0;    ///< edges at the first node: 1 at an end, 3 and more at a
                                       ///< junction, 2 on a ring
    std::uint32_t stop_degree = 0;     ///< edges at the last node
    double length = 0.0;               ///< model units
    double mean_radius = 0.0;          ///< over the length
    double tortuosity = 1.0;           ///< length over the straight distance of its two ends;
                                       ///< infinite where the two are one
};

/// Every branch once, from the end with the lower number, in the order of their first nodes.
std::vector<Branch> find_branches(const SkeletonGraph& graph);

/// Connected components of the graph, and independent cycles: edges - nodes + components.
struct GraphTopology {
    std::size_t components = 0;
    std::size_t cycles = 0;
};
GraphTopology graph_topology(const SkeletonGraph& graph);

}  // namespace zskel
