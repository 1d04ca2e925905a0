#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// The neighbours of every vertex along edges, in one flat array.
class VertexGraph {
  public:
    struct Link {
        std::uint32_t vertex;  ///< the neighbour
        std::uint32_t edge;    ///< number in Surface::edges
    };

    VertexGraph(std::size_t vertices, std::span<const glm::uvec2> edges)
        : first_(vertices + 1, 0), links_(edges.size() * 2) {
        for (const glm::uvec2& e : edges) {
            ++first_[e.x + 1];
            ++first_[e.y + 1];
        }
        for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            links_[next[edges[e].x]++] = {edges[e].y, e};
            links_[next[edges[e].y]++] = {edges[e].x, e};
        }
    }

    std::span<const Link> of(std::uint32_t vertex) const {
        return std::span(links_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }
    std::size_t size() const { return first_.size() - 1; }

  private:
    std::vector<std::uint32_t> first_;
    std::vector<Link> links_;
};

}  // namespace zskel
