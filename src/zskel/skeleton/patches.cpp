#include "zskel/skeleton/patches.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

std::uint32_t nearest_along(const Vec3& point, std::uint32_t node, std::span<const Vec3> nodes,
                            const NodeLinks& links) {
    while (true) {
        std::uint32_t best = node;
        for (const std::uint32_t next : links[node]) {
            if (glm::distance(point, nodes[next]) < glm::distance(point, nodes[best])) best = next;
        }
        if (best == node) return node;
        node = best;
    }
}

// Takes the node away from all vertices that are not in the largest patch of theirs.
void keep_largest(const VertexGraph& graph, std::size_t node_count,
                  std::vector<std::uint32_t>& vertex_node) {
    std::vector<std::vector<std::uint32_t>> largest(node_count);
    std::vector<bool> seen(vertex_node.size(), false);
    for (std::uint32_t first = 0; first < vertex_node.size(); ++first) {
        if (seen[first]) continue;
        std::vector<std::uint32_t> patch{first};
        seen[first] = true;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            for (const VertexGraph::Link& link : graph.of(patch[i])) {
                if (seen[link.vertex] || vertex_node[link.vertex] != vertex_node[first]) continue;
                seen[link.vertex] = true;
                patch.push_back(link.vertex);
            }
        }
        std::vector<std::uint32_t>& best = largest[vertex_node[first]];
        if (patch.size() > best.size()) best = std::move(patch);
    }
    std::vector<std::uint32_t> kept(vertex_node.size(), kNone);
    for (std::uint32_t n = 0; n < node_count; ++n) {
        for (const std::uint32_t v : largest[n]) kept[v] = n;
    }
    vertex_node = std::move(kept);
}

// Patches grow over the vertices without a node, nearest first.
void fill(const Surface& surface, const VertexGraph& graph,
          std::vector<std::uint32_t>& vertex_node) {
    using Entry = std::pair<float, std::uint32_t>;
    std::vector<float> distance(vertex_node.size(), kInfinity);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (std::uint32_t v = 0; v < vertex_node.size(); ++v) {
        if (vertex_node[v] == kNone) continue;
        distance[v] = 0.0f;
        front.emplace(0.0f, v);
    }
    while (!front.empty()) {
        const auto [passed, v] = front.top();
        front.pop();
        if (passed > distance[v]) continue;
        for (const VertexGraph::Link& link : graph.of(v)) {
            const float there =
                passed + glm::distance(surface.positions[v], surface.positions[link.vertex]);
            if (there >= distance[link.vertex]) continue;
            distance[link.vertex] = there;
            vertex_node[link.vertex] = vertex_node[v];
            front.emplace(there, link.vertex);
        }
    }
}

}  // namespace

std::vector<std::uint32_t> assign_patches(const Surface& surface, std::span<const Vec3> nodes,
                                          const NodeLinks& links,
                                          std::span<const std::uint32_t> near) {
    std::vector<std::uint32_t> vertex_node(near.size());
    parallel_for(near.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            vertex_node[v] = nearest_along(surface.positions[v], near[v], nodes, links);
    });
    const VertexGraph graph(surface.positions.size(), surface.edges);
    const std::vector<std::uint32_t> nearest = vertex_node;
    keep_largest(graph, nodes.size(), vertex_node);
    fill(surface, graph, vertex_node);
    // A cavity that holds no node's largest patch.
    for (std::size_t v = 0; v < nearest.size(); ++v) {
        if (vertex_node[v] == kNone) vertex_node[v] = nearest[v];
    }
    return vertex_node;
}

}  // namespace zskel
