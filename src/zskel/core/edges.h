#pragma once

#include <algorithm>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// The order that lists of edges are kept in.
inline bool edge_before(const glm::uvec2& l, const glm::uvec2& r) {
    return l.x != r.x ? l.x < r.x : l.y < r.y;
}

/// Sorts edges and leaves each once.
inline void sort_edges(std::vector<glm::uvec2>& edges) {
    std::sort(edges.begin(), edges.end(), edge_before);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace zskel
