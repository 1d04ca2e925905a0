#include "zskel/skeleton/spread.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

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
        : reached_(surface.positions.size()) {
        // Every vertex' links stand together, in the order of the edges.
        first_.assign(surface.positions.size() + 1, 0);
        for (const glm::uvec2& e : surface.edges) {
            ++first_[e.x + 1];
            ++first_[e.y + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        links_.resize(surface.edges.size() * 2);
        for (const glm::uvec2& e : surface.edges) {
            const float length = glm::distance(surface.positions[e.x], surface.positions[e.y]);
            const float relative = 2.0f * length / (thickness[e.x] + thickness[e.y]);
            links_[next[e.x]++] = {e.y, relative};
            links_[next[e.y]++] = {e.x, relative};
        }
        double sum = 0.0;
        for (const Link& link : links_) sum += static_cast<double>(link.length);
        const double mean = links_.empty() ? 0.0 : sum / static_cast<double>(links_.size());
        if (mean > 0.0 && std::isfinite(mean)) bucket_width_ = static_cast<float>(mean);
    }

    // A front grows from the new seed as far as it is the nearest one. Its vertices wait in buckets
    // of about an edge's length; within one they may be put right again.
    void add(std::uint32_t vertex) {
        const auto seed = static_cast<std::uint32_t>(seeds_.size());
        seeds_.push_back(vertex);
        reached_[vertex] = {0.0f, seed, vertex};
        push(0, vertex);
        for (std::size_t b = 0; b < front_.size(); ++b) {
            for (std::size_t i = 0; i < front_[b].size(); ++i) {
                const std::uint32_t v = front_[b][i];
                const Reached here = reached_[v];
                if (here.seed == seed && bucket_of(here.distance) == b) grow(v, here);
            }
            front_[b].clear();
            if (b >= last_bucket_) break;
        }
        last_bucket_ = 0;
    }

    // The vertex that is farthest from every seed; of several the lowest. The queue holds all that
    // are at least `queued_from_` away, since distances only shrink; stale entries are put right as
    // they come up.
    std::uint32_t farthest() {
        while (true) {
            if (far_.empty()) queue_far_ones();
            const std::uint32_t v = ~vertex_of(far_.top());
            const float now = reached_[v].distance;
            if (distance_of(far_.top()) == now) return v;
            far_.pop();
            if (now >= queued_from_) far_.push(entry_of(now, ~v));
        }
    }

    float distance(std::uint32_t v) const { return reached_[v].distance; }

    SeedSpread take() {
        SeedSpread out;
        out.vertices = std::move(seeds_);
        out.seed_of.reserve(reached_.size());
        out.parent.reserve(reached_.size());
        for (const Reached& r : reached_) {
            out.seed_of.push_back(r.seed);
            out.parent.push_back(r.parent);
        }
        return out;
    }

  private:
    // Together, since a front asks for all three of one vertex after the other.
    struct Reached {
        float distance = kInfinity;  // to the nearest seed, over the local thickness
        std::uint32_t seed = kNone;
        std::uint32_t parent = kNone;
    };
    struct Link {
        std::uint32_t vertex;
        float length;
    };

    void grow(std::uint32_t v, const Reached& here) {
        for (std::uint32_t l = first_[v]; l < first_[v + 1]; ++l) {
            Reached& next = reached_[links_[l].vertex];
            const float along = here.distance + links_[l].length;
            // What hangs on a vertex goes with it, even where rounding makes the ways equal.
            const bool hangs_on = next.parent == v && next.seed != here.seed;
            if (along > next.distance || (along == next.distance && !hangs_on)) continue;
            next = {along, here.seed, v};
            push(bucket_of(along), links_[l].vertex);
        }
    }

    std::size_t bucket_of(float distance) const {
        return static_cast<std::size_t>(std::min(distance / bucket_width_, kMostBuckets));
    }

    void push(std::size_t bucket, std::uint32_t vertex) {
        if (bucket >= front_.size()) front_.resize(bucket + 1);
        front_[bucket].push_back(vertex);
        last_bucket_ = std::max(last_bucket_, bucket);
    }

    void queue_far_ones() {
        float most = 0.0f;
        for (const Reached& r : reached_) most = std::max(most, r.distance);
        queued_from_ = kQueuedShare * most;
        for (std::uint32_t v = 0; v < reached_.size(); ++v) {
            if (reached_[v].distance >= queued_from_) far_.push(entry_of(reached_[v].distance, ~v));
        }
    }

    static constexpr float kQueuedShare = 0.8f;
    static constexpr float kMostBuckets = 1e6f;

    std::vector<std::uint32_t> first_;  // of every vertex, in the links; and their end
    std::vector<Link> links_;
    std::vector<Reached> reached_;
    std::vector<std::uint32_t> seeds_;
    std::vector<std::vector<std::uint32_t>> front_;  // by distance
    float bucket_width_ = 1.0f;
    std::size_t last_bucket_ = 0;
    std::priority_queue<Entry> far_;  // ties: the lowest vertex
    float queued_from_ = 0.0f;
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
    std::uint32_t next = 0;
    std::size_t count = 0;
    const auto is_enough = [&](double left) {
        if (count >= options.max_seeds) return true;
        return count >= options.min_seeds &&
               left <=
                   (count < options.many_seeds ? options.fine_thickness : options.coarse_thickness);
    };
    // Parts that no front has reached come first, whatever the limit: their distance is infinite.
    for (; count < vertices; ++count) {
        const float left = spreader.distance(next);
        if (left == 0.0f || (left < kInfinity && is_enough(static_cast<double>(left)))) break;
        spreader.add(next);
        next = spreader.farthest();
    }
    SeedSpread spread = spreader.take();
    spread.spacing_thickness = static_cast<double>(spreader.distance(next));
    if (spread.spacing_thickness == 0.0)
        spread.end = SpreadEnd::EveryVertex;
    else if (count >= options.max_seeds)
        spread.end = SpreadEnd::Limit;
    return spread;
}

}  // namespace zskel
