#include "scoring/sides.h"

#include "zskel/core/disjoint_sets.h"

namespace zskel::scoring {

CurveSides::CurveSides(const Subject& subject, const SkeletonGraph& graph)
    : subject_(subject), graph_(graph), node_inside_(graph.nodes.size()) {
    DisjointSets sets(graph.nodes.size());
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        const bool is_free =
            subject.is_closed() &&
            subject.is_free(graph.nodes[edge.source].position, graph.nodes[edge.target].position);
        edge_free_.push_back(is_free);
        if (is_free) sets.unite(edge.source, edge.target);
    }
    // The root of a set is its lowest member, so it is known before the others.
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        const std::uint32_t root = sets.find(n);
        node_inside_[n] =
            root == n ? subject.is_inside(graph.nodes[n].position) : node_inside_[root];
    }
}

bool CurveSides::is_inside(const CurveSample& sample) const {
    if (sample.edge == kNone || !edge_free_[sample.edge])
        return subject_.is_inside(sample.position);
    return node_inside_[graph_.edges[sample.edge].source];
}

double CurveSides::inside_share(std::span<const CurveSample> samples) const {
    double inside = 0.0;
    double all = 0.0;
    for (const CurveSample& sample : samples) {
        all += sample.weight;
        if (is_inside(sample)) inside += sample.weight;
    }
    return all > 0.0 ? inside / all : 0.0;
}

}  // namespace zskel::scoring
