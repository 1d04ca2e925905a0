// NetworkX's node-link data: `networkx.node_link_graph` of any version. Up to 3.5 it takes the
// edges from `links` unless told otherwise, later from `edges`; both are there.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "zskel/io/format_io.h"

namespace zskel {
namespace {

using Json = nlohmann::ordered_json;

Json nodes_of(const SkeletonGraph& graph) {
    Json nodes = Json::array();
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const SkeletonGraph::Node& node = graph.nodes[i];
        nodes.push_back({{"id", i},
                         {"x", node.position.x},
                         {"y", node.position.y},
                         {"z", node.position.z},
                         {"radius", node.radius},
                         {"volume", node.volume},
                         {"solid", node.solid}});
    }
    return nodes;
}

Json edges_of(const SkeletonGraph& graph) {
    Json edges = Json::array();
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        const double length =
            glm::distance(graph.nodes[edge.source].position, graph.nodes[edge.target].position);
        edges.push_back({{"source", edge.source}, {"target", edge.target}, {"length", length}});
    }
    return edges;
}

}  // namespace

std::string write_node_link(const SkeletonGraph& graph, const std::string& origin) {
    Json vertex_node = Json::array();
    for (const std::uint32_t node : graph.vertex_node)
        vertex_node.push_back(node == kNone ? std::int64_t{-1} : static_cast<std::int64_t>(node));
    const Json edges = edges_of(graph);
    const Json data{
        {"directed", false},
        {"multigraph", false},
        {"graph", {{"origin", origin}, {"units", "model"}, {"vertex_node", vertex_node}}},
        {"nodes", nodes_of(graph)},
        {"links", edges},
        {"edges", edges}};
    return data.dump() + "\n";
}

}  // namespace zskel
