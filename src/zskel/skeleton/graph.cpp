#include "zskel/skeleton/graph.h"

#include "zskel/core/disjoint_sets.h"

namespace zskel {

std::vector<std::uint32_t> node_degrees(const SkeletonGraph& graph) {
    std::vector<std::uint32_t> degrees(graph.nodes.size(), 0);
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        ++degrees[edge.source];
        ++degrees[edge.target];
    }
    return degrees;
}

GraphTopology graph_topology(const SkeletonGraph& graph) {
    DisjointSets sets(graph.nodes.size());
    std::size_t components = graph.nodes.size();
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        components -= sets.unite(edge.source, edge.target) ? 1 : 0;
    }
    return {components, graph.edges.size() + components - graph.nodes.size()};
}

}  // namespace zskel
