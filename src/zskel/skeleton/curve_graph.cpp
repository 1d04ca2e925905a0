#include "zskel/skeleton/curve_graph.h"

#include <algorithm>

namespace zskel {
namespace {

void remove_one(std::vector<std::uint32_t>& links, std::uint32_t node) {
    const auto at = std::find(links.begin(), links.end(), node);
    if (at != links.end()) links.erase(at);
}

auto links_in(const CurveGraph& graph) {
    return [&graph](std::uint32_t n) -> const std::vector<std::uint32_t>& {
        return graph.nodes[n].links;
    };
}

// New nodes on from `first`, each linked to the one before; returns the last.
std::uint32_t add_chain(CurveGraph& graph, std::uint32_t first, std::span<const Vec3> points) {
    std::uint32_t last = first;
    for (const Vec3& point : points) {
        const std::uint32_t next = graph.add(point);
        graph.link(last, next);
        last = next;
    }
    return last;
}

}  // namespace

std::uint32_t CurveGraph::add(const Vec3& position, float radius) {
    nodes.push_back({position, radius, {}, {}, false});
    return static_cast<std::uint32_t>(nodes.size() - 1);
}

void CurveGraph::link(std::uint32_t a, std::uint32_t b) {
    nodes[a].links.push_back(b);
    nodes[b].links.push_back(a);
}

void CurveGraph::unlink(std::uint32_t a, std::uint32_t b) {
    remove_one(nodes[a].links, b);
    remove_one(nodes[b].links, a);
}

float CurveGraph::length_along(std::span<const std::uint32_t> branch) const {
    float sum = 0.0f;
    for (std::size_t i = 1; i < branch.size(); ++i)
        sum += glm::distance(at(branch[i - 1]), at(branch[i]));
    return sum;
}

void CurveGraph::give_up(std::uint32_t node, std::uint32_t to) {
    std::vector<std::uint32_t>& all = nodes[to].seeds;
    all.insert(all.end(), nodes[node].seeds.begin(), nodes[node].seeds.end());
    nodes[node].seeds.clear();
    nodes[node].is_removed = true;
}

std::vector<std::uint32_t> CurveGraph::branch_from(std::uint32_t first,
                                                   std::uint32_t second) const {
    return walk_branch(links_in(*this), first, second);
}

std::vector<std::vector<std::uint32_t>> CurveGraph::branches() const {
    return trace_branches(nodes.size(), links_in(*this));
}

CurveGraph build_graph(const ClusterContext& context, const Limbs& limbs) {
    CurveGraph graph;
    std::vector<std::uint32_t> number(limbs.home.size(), kNone);
    for (std::uint32_t c = 0; c < limbs.home.size(); ++c) {
        if (limbs.home[c] != c) continue;
        number[c] = graph.add(context.clusters.centers[c]);
    }
    for (std::uint32_t s = 0; s < context.clusters.of_point.size(); ++s) {
        graph.nodes[number[limbs.home[context.clusters.of_point[s]]]].seeds.push_back(s);
    }
    for (const Connection& c : limbs.connections) {
        const std::span<const Vec3> within = std::span(c.path).subspan(1, c.path.size() - 2);
        graph.link(add_chain(graph, number[c.a], within), number[c.b]);
    }
    for (const Limbs::Tip& tip : limbs.tips)
        add_chain(graph, number[tip.cluster], std::span(tip.path).subspan(1));
    for (CurveGraph::Node& node : graph.nodes)
        node.radius = context.query.nearest(node.position).distance;
    return graph;
}

}  // namespace zskel
