#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "zskel/core/disjoint_sets.h"
#include "zskel/extract.h"
#include "zskel/mesh/integer_basis.h"
#include "zskel/mesh/linking.h"
#include "zskel/mesh/loops.h"

namespace zskel::test {

/// The cycles that the edges outside a spanning tree close: nodes in order.
inline std::vector<std::vector<std::uint32_t>> tree_cycles(const SkeletonGraph& graph) {
    DisjointSets sets(graph.nodes.size());
    std::vector<std::vector<std::uint32_t>> tree(graph.nodes.size());
    std::vector<SkeletonGraph::Edge> others;
    for (const SkeletonGraph::Edge& e : graph.edges) {
        if (!sets.unite(e.source, e.target)) {
            others.push_back(e);
            continue;
        }
        tree[e.source].push_back(e.target);
        tree[e.target].push_back(e.source);
    }
    std::vector<std::vector<std::uint32_t>> cycles;
    for (const SkeletonGraph::Edge& e : others) {
        std::vector<std::uint32_t> parent(graph.nodes.size(), kNone);
        std::vector<std::uint32_t> queue{e.source};
        parent[e.source] = e.source;
        for (std::size_t i = 0; i < queue.size() && parent[e.target] == kNone; ++i) {
            for (const std::uint32_t n : tree[queue[i]]) {
                if (parent[n] != kNone) continue;
                parent[n] = queue[i];
                queue.push_back(n);
            }
        }
        std::vector<std::uint32_t>& cycle = cycles.emplace_back(1, e.target);
        while (cycle.back() != e.source) cycle.push_back(parent[cycle.back()]);
    }
    return cycles;
}

/// How many of a skeleton's cycles, one after the other, are part of a basis over the integers of
/// what goes round in the solid: told by their linking numbers with loops on the surface.
inline std::size_t cycles_of_a_basis(const ExtractResult& result) {
    const std::vector<std::vector<std::uint32_t>> loops = find_loops(result.surface)->loops;
    std::vector<glm::uvec2> edges;
    std::vector<std::size_t> loop_of_edge;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = 0; i < loops[l].size(); ++i) {
            edges.emplace_back(loops[l][i], loops[l][(i + 1) % loops[l].size()]);
            loop_of_edge.push_back(l);
        }
    }
    const Passages passages(result.surface.positions, edges);
    const auto place = [&](std::uint32_t node) {
        return result.surface.world_from_model.to_world(result.graph.nodes[node].position);
    };
    IntegerBasis basis(loops.size());
    for (const std::vector<std::uint32_t>& cycle : tree_cycles(result.graph)) {
        IntegerBasis::Vector links(loops.size(), 0);
        std::vector<Passages::Passage> over;
        for (std::size_t i = 0; i < cycle.size(); ++i)
            passages.find(place(cycle[i]), place(cycle[(i + 1) % cycle.size()]), over);
        for (const Passages::Passage& p : over) links[loop_of_edge[p.edge]] += p.sign;
        basis.extend(std::move(links));
    }
    return basis.size();
}

}  // namespace zskel::test
