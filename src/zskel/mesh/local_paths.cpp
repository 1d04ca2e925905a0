#include "zskel/mesh/local_paths.h"

#include <functional>
#include <queue>
#include <utility>

namespace zskel {

void LocalPaths::run(std::uint32_t root, float radius) {
    for (const std::uint32_t v : reached_) at_[v] = {};
    reached_.clear();
    using Entry = std::pair<float, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    at_[root] = {0.0f, root, kNone, {}};
    front.emplace(0.0f, root);
    reached_.push_back(root);
    while (!front.empty()) {
        const auto [distance, v] = front.top();
        front.pop();
        if (distance > at_[v].distance) continue;
        for (const VertexGraph::Link& link : graph_.of(v)) {
            const float along = distance + length(v, link.vertex);
            Place& next = at_[link.vertex];
            if (along > radius || along >= next.distance) continue;
            if (next.distance == kInfinity) reached_.push_back(link.vertex);
            next = {along, v, link.edge, at_[v].sums + along_edge(v, link)};
            front.emplace(along, link.vertex);
        }
    }
}

std::vector<std::uint32_t> LocalPaths::path_from(std::uint32_t vertex) const {
    std::vector<std::uint32_t> path{vertex};
    while (at_[path.back()].edge != kNone) path.push_back(at_[path.back()].parent);
    return path;
}

}  // namespace zskel
