#include "zskel/skeleton/spread.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <queue>

#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

// A distance and a vertex as one number: in order of distance, then of vertex.
using Entry = std::uint64_t;
Entry entry_of(float distance, std::uint32_t vertex) {
    return Entry{std::bit_cast<std::uint32_t>(distance)} << 32 | vertex;
}
float distance_of(Entry entry) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(entry >> 32));
}
std::uint32_t vertex_of(Entry entry) {
    return static_cast<std::uint32_t>(entry);
}

class Spreader {
  public:
    Spreader(const Surface& surface, std::span<const float> thickness)
        : surface_(surface),
          thickness_(thickness),
          graph_(surface.positions.size(), surface.edges),
          distance_(surface.positions.size(), kInfinity) {
        lengths_.reserve(surface.edges.size());
        for (const glm::uvec2& e : surface.edges) lengths_.push_back(length(e.x, e.y));
        out_.seed_of.assign(surface.positions.size(), kNone);
        out_.parent.assign(surface.positions.size(), kNone);
    }

    // A front grows from the new seed as far as it is the nearest one.
    void add(std::uint32_t vertex) {
        const auto seed = static_cast<std::uint32_t>(out_.vertices.size());
        out_.vertices.push_back(vertex);
        reach(vertex, 0.0f, seed, vertex);
        front_.push(entry_of(0.0f, vertex));
        while (!front_.empty()) {
            const float distance = distance_of(front_.top());
            const std::uint32_t v = vertex_of(front_.top());
            front_.pop();
            if (distance > distance_[v] || out_.seed_of[v] != seed) continue;
            for (const VertexGraph::Link& link : graph_.of(v)) {
                const float along = distance + lengths_[link.edge];
                // What hangs on a vertex goes with it, even where rounding makes the ways equal.
                const bool is_child = out_.parent[link.vertex] == v;
                const float known = distance_[link.vertex];
                if (along > known || (along == known && !is_child)) continue;
                reach(link.vertex, along, seed, v);
                front_.push(entry_of(along, link.vertex));
            }
        }
    }

    // The vertex that is farthest from every seed; stale entries of the queue are put right as they
    // come up.
    std::uint32_t farthest() {
        if (far_.empty()) {
            for (std::uint32_t v = 0; v < distance_.size(); ++v)
                far_.push(entry_of(distance_[v], ~v));
        }
        while (true) {
            const std::uint32_t v = ~vertex_of(far_.top());
            if (distance_of(far_.top()) == distance_[v]) return v;
            far_.pop();
            far_.push(entry_of(distance_[v], ~v));
        }
    }

    float distance(std::uint32_t v) const { return distance_[v]; }
    SeedSpread take() { return std::move(out_); }

  private:
    void reach(std::uint32_t v, float distance, std::uint32_t seed, std::uint32_t parent) {
        distance_[v] = distance;
        out_.seed_of[v] = seed;
        out_.parent[v] = parent;
    }

    float length(std::uint32_t a, std::uint32_t b) const {
        return 2.0f * glm::distance(surface_.positions[a], surface_.positions[b]) /
               (thickness_[a] + thickness_[b]);
    }

    const Surface& surface_;
    std::span<const float> thickness_;
    VertexGraph graph_;
    std::vector<float> lengths_;  // of the edges, over the local thickness
    std::vector<float> distance_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
    std::priority_queue<Entry> far_;  // ties: the lowest vertex
    SeedSpread out_;
};

}  // namespace

std::string_view name_of(SpreadEnd end) {
    switch (end) {
        case SpreadEnd::Spacing:
            return "spacing";
        case SpreadEnd::EveryVertex:
            return "every_vertex";
        case SpreadEnd::Limit:
            return "limit";
    }
    return "";
}

SeedSpread spread_seeds(const Surface& surface, std::span<const float> thickness,
                        const SpreadOptions& options) {
    Spreader spreader(surface, thickness);
    const std::size_t vertices = surface.positions.size();
    const std::size_t least = std::min(options.min_seeds, options.max_seeds);
    std::uint32_t next = 0;
    std::size_t count = 0;
    // Parts that no front has reached come first, whatever the limit: their distance is infinite.
    for (; count < vertices; ++count) {
        const float left = spreader.distance(next);
        if (left == 0.0f) break;
        const bool is_near = static_cast<double>(left) <= options.spacing_thickness;
        const bool enough = count >= options.max_seeds || (count >= least && is_near);
        if (enough && left < kInfinity) break;
        spreader.add(next);
        next = spreader.farthest();
    }
    SeedSpread spread = spreader.take();
    spread.spacing_thickness = static_cast<double>(spreader.distance(next));
    if (spread.spacing_thickness == 0.0)
        spread.end = SpreadEnd::EveryVertex;
    else if (spread.spacing_thickness > options.spacing_thickness || options.max_seeds == least)
        spread.end = SpreadEnd::Limit;
    return spread;
}

}  // namespace zskel
