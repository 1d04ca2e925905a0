#include "zskel/skeleton/connect.h"

#include <algorithm>
#include <numeric>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/edges.h"

namespace zskel {
std::vector<glm::uvec2> connect_clusters(std::span<const std::uint32_t> cluster_of_point,
                                         std::span<const glm::uvec2> links) {
    std::vector<glm::uvec2> edges;
    for (const glm::uvec2& link : links) {
        const std::uint32_t a = cluster_of_point[link.x];
        const std::uint32_t b = cluster_of_point[link.y];
        if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
    sort_edges(edges);
    return edges;
}

std::vector<glm::uvec2> spanning_forest(std::span<const Vec3> centers,
                                        std::span<const glm::uvec2> edges) {
    std::vector<std::uint32_t> order(edges.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto length = [&](std::uint32_t e) {
        return glm::distance(centers[edges[e].x], centers[edges[e].y]);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto l, auto r) { return length(l) < length(r); });
    DisjointSets sets(centers.size());
    std::vector<glm::uvec2> kept;
    for (const std::uint32_t e : order) {
        if (sets.unite(edges[e].x, edges[e].y)) kept.push_back(edges[e]);
    }
    sort_edges(kept);
    return kept;
}

}  // namespace zskel
