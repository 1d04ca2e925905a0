// Shapes compared by their skeletons (the paper's section 6 names it as what skeletons are for).
// Every place of a skeleton is described by how volume and length are spread over the ways from
// there; shapes are as far apart as the best assignment of places to places leaves these different
// (Memoli 2011, third lower bound).
#include "zskel/match/signature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <queue>

#include "zskel/core/error.h"
#include "zskel/match/assignment.h"

namespace zskel {
namespace {

constexpr double kRadiusWeight = 1.0;

// Nodes with what belongs to each: volume, and half of every edge that it is on.
struct Weighted {
    std::vector<double> volume;
    std::vector<double> length;
    NodeLinks links;
};

Weighted weighted(const SkeletonGraph& graph) {
    Weighted out;
    out.links = node_links(graph);
    out.length.assign(graph.nodes.size(), 0.0);
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        const double half = 0.5 * glm::distance(graph.nodes[edge.source].position,
                                                graph.nodes[edge.target].position);
        out.length[edge.source] += half;
        out.length[edge.target] += half;
    }
    std::map<std::uint32_t, double> of_solid;
    for (const SkeletonGraph::Node& node : graph.nodes) of_solid[node.solid] += node.volume;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const SkeletonGraph::Node& node = graph.nodes[n];
        // A stretch of tube; a ball where there is no stretch.
        const double tube = std::numbers::pi * node.radius * node.radius *
                            std::max(out.length[n], 4.0 / 3.0 * node.radius);
        const bool has_volumes = of_solid[node.solid] > 0.0;
        out.volume.push_back(has_volumes ? std::max(node.volume, 0.0) : tube);
    }
    return out;
}

// Lengths of the shortest ways from a node; infinite to other parts.
std::vector<double> ways_from(std::uint32_t start, const SkeletonGraph& graph,
                              const NodeLinks& links) {
    std::vector<double> way(graph.nodes.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    way[start] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
        const auto [length, node] = open.top();
        open.pop();
        if (length > way[node]) continue;
        for (const std::uint32_t next : links[node]) {
            const double through =
                length + glm::distance(graph.nodes[node].position, graph.nodes[next].position);
            if (through < way[next]) {
                way[next] = through;
                open.emplace(through, next);
            }
        }
    }
    return way;
}

// The ways within which equal shares of a weight lie.
std::array<float, kProfile> profile_of(const std::vector<std::uint32_t>& by_way,
                                       const std::vector<double>& way,
                                       const std::vector<double>& weight, double unit) {
    const double whole = std::accumulate(weight.begin(), weight.end(), 0.0);
    std::array<float, kProfile> out{};
    double passed = 0.0;
    std::size_t k = 0;
    for (const std::uint32_t node : by_way) {
        passed += weight[node];
        while (k < kProfile && passed >= whole * (static_cast<double>(k) + 0.5) / kProfile)
            out[k++] = static_cast<float>(way[node] / unit);
    }
    while (k < kProfile) out[k++] = static_cast<float>(way[by_way.back()] / unit);
    return out;
}

// Nodes at equal shares of the length, branch by branch; without length, all are the first node.
std::vector<std::uint32_t> station_nodes(const SkeletonGraph& graph,
                                         const std::vector<double>& length) {
    std::vector<std::uint32_t> order;
    std::vector<bool> is_taken(graph.nodes.size(), false);
    const auto take = [&](std::uint32_t node) {
        if (is_taken[node]) return;
        is_taken[node] = true;
        order.push_back(node);
    };
    for (const Branch& branch : find_branches(graph)) {
        for (const std::uint32_t node : branch.nodes) take(node);
    }
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) take(n);
    const double whole = std::accumulate(length.begin(), length.end(), 0.0);
    std::vector<std::uint32_t> out;
    double passed = 0.0;
    for (const std::uint32_t node : order) {
        passed += length[node];
        while (out.size() < kStations &&
               passed >= whole * (static_cast<double>(out.size()) + 0.5) / kStations)
            out.push_back(node);
    }
    out.resize(kStations, order.back());
    return out;
}

double cost_of(const Station& a, const Station& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kProfile; ++k) {
        sum += std::abs(static_cast<double>(a.by_volume[k]) - b.by_volume[k]) +
               std::abs(static_cast<double>(a.by_length[k]) - b.by_length[k]);
    }
    return sum / (2.0 * kProfile) +
           kRadiusWeight * std::abs(static_cast<double>(a.radius) - b.radius);
}

}  // namespace

Signature signature_of(const SkeletonGraph& graph) {
    if (graph.nodes.empty()) throw InputError("a skeleton without nodes has no signature");
    const Weighted weights = weighted(graph);
    const double volume = std::accumulate(weights.volume.begin(), weights.volume.end(), 0.0);
    const double unit = std::cbrt(volume);
    if (!(unit > 0.0) || !std::isfinite(unit))
        throw InputError("a skeleton without radii and volumes has no signature");
    const std::vector<std::uint32_t> nodes = station_nodes(graph, weights.length);
    std::vector<std::vector<double>> ways;
    double longest = 0.0;
    for (const std::uint32_t node : nodes) {
        ways.push_back(ways_from(node, graph, weights.links));
        for (const double way : ways.back()) {
            if (std::isfinite(way)) longest = std::max(longest, way);
        }
    }
    Signature out;
    for (std::size_t s = 0; s < nodes.size(); ++s) {
        std::vector<double>& way = ways[s];
        for (double& w : way) w = std::min(w, 2.0 * longest);
        std::vector<std::uint32_t> by_way(graph.nodes.size());
        std::iota(by_way.begin(), by_way.end(), 0u);
        std::stable_sort(by_way.begin(), by_way.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return way[a] < way[b]; });
        out.push_back({nodes[s], profile_of(by_way, way, weights.volume, unit),
                       profile_of(by_way, way, weights.length, unit),
                       static_cast<float>(graph.nodes[nodes[s]].radius / unit)});
    }
    return out;
}

Match match_signatures(const Signature& a, const Signature& b) {
    std::vector<double> cost;
    cost.reserve(a.size() * b.size());
    for (const Station& one : a) {
        for (const Station& other : b) cost.push_back(cost_of(one, other));
    }
    Match out;
    out.other = cheapest_assignment(cost, a.size());
    for (std::size_t s = 0; s < a.size(); ++s) out.distance += cost[s * a.size() + out.other[s]];
    out.distance /= static_cast<double>(a.size());
    return out;
}

}  // namespace zskel
