#include "zskel/skeleton/graph.h"

#include <algorithm>
#include <utility>

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

NodeLinks node_links(const SkeletonGraph& graph) {
    NodeLinks links(graph.nodes.size());
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        links[edge.source].push_back(edge.target);
        links[edge.target].push_back(edge.source);
    }
    for (std::vector<std::uint32_t>& list : links) std::sort(list.begin(), list.end());
    return links;
}

std::vector<Branch> find_branches(const SkeletonGraph& graph) {
    const NodeLinks links = node_links(graph);
    const auto links_of = [&](std::uint32_t n) -> const std::vector<std::uint32_t>& {
        return links[n];
    };
    std::vector<Branch> out;
    for (std::vector<std::uint32_t>& nodes : trace_branches(links.size(), links_of)) {
        Branch branch;
        branch.start_degree = static_cast<std::uint32_t>(links[nodes.front()].size());
        branch.stop_degree = static_cast<std::uint32_t>(links[nodes.back()].size());
        branch.is_ring = branch.start_degree == 2;
        double radius_length = 0.0;
        for (std::size_t i = 1; i < nodes.size(); ++i) {
            const SkeletonGraph::Node& a = graph.nodes[nodes[i - 1]];
            const SkeletonGraph::Node& b = graph.nodes[nodes[i]];
            const double length = glm::distance(a.position, b.position);
            branch.length += length;
            radius_length += 0.5 * (a.radius + b.radius) * length;
        }
        const DVec3& first = graph.nodes[nodes.front()].position;
        const DVec3& last = graph.nodes[nodes.back()].position;
        branch.mean_radius =
            branch.length > 0.0 ? radius_length / branch.length : graph.nodes[nodes[0]].radius;
        branch.tortuosity = branch.length / glm::distance(first, last);
        branch.nodes = std::move(nodes);
        out.push_back(std::move(branch));
    }
    return out;
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
