#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/surface.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {

/// Sums of random numbers along a closed walk: zero when it is nothing in the homology of the
/// inside, or of the outside (but for a chance of about 2^-60).
struct WalkSums {
    std::uint64_t inside = 0;
    std::uint64_t outside = 0;

    WalkSums operator+(const WalkSums& other) const {
        return {inside + other.inside, outside + other.outside};
    }
    WalkSums operator-(const WalkSums& other) const {
        return {inside - other.inside, outside - other.outside};
    }
};

/// Shortest paths from one vertex as far as a radius; made once, run often.
class LocalPaths {
  public:
    /// All must outlive this. @param edge_sums  of every edge, from its low to its high vertex.
    LocalPaths(const Surface& surface, const VertexGraph& graph,
               const std::vector<WalkSums>& edge_sums)
        : surface_(surface), graph_(graph), edge_sums_(edge_sums), at_(graph.size()) {}

    void run(std::uint32_t root, float radius);

    /// Calls visit(edge, length, sums) for every loop that one edge closes.
    template <typename Visit>
    void each_loop(Visit visit) const {
        for (const std::uint32_t v : reached_) {
            for (const VertexGraph::Link& link : graph_.of(v)) {
                const Place& other = at_[link.vertex];
                if (v > link.vertex || other.distance == kInfinity) continue;
                if (other.edge == link.edge || at_[v].edge == link.edge) continue;
                visit(link.edge, at_[v].distance + other.distance + length(v, link.vertex),
                      at_[v].sums + along_edge(v, link) - other.sums);
            }
        }
    }

    /// The root and every vertex within the radius.
    const std::vector<std::uint32_t>& reached() const { return reached_; }

    /// From a vertex that was reached to the root.
    std::vector<std::uint32_t> path_from(std::uint32_t vertex) const;

  private:
    struct Place {
        float distance = kInfinity;
        std::uint32_t parent = kNone;
        std::uint32_t edge = kNone;  // to the parent
        WalkSums sums;               // from the root
    };

    float length(std::uint32_t a, std::uint32_t b) const {
        return glm::distance(surface_.positions[a], surface_.positions[b]);
    }
    WalkSums along_edge(std::uint32_t v, const VertexGraph::Link& link) const {
        return v < link.vertex ? edge_sums_[link.edge] : WalkSums{} - edge_sums_[link.edge];
    }

    const Surface& surface_;
    const VertexGraph& graph_;
    const std::vector<WalkSums>& edge_sums_;
    std::vector<Place> at_;
    std::vector<std::uint32_t> reached_;
};

}  // namespace zskel
