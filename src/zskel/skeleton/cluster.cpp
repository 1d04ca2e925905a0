#include "zskel/skeleton/cluster.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace zskel {
namespace {

struct Pair {
    double distance;  // over the range
    std::uint32_t a;  // cluster names: their number in order of making, points first
    std::uint32_t b;
    std::uint64_t name() const { return std::uint64_t{a} << 32 | b; }
    bool operator>(const Pair& other) const {
        return distance != other.distance ? distance > other.distance : name() > other.name();
    }
};

// The least pair first. Pairs lie in buckets by their distance, at most 1, each bucket a heap; most
// of them die before their turn.
class PairQueue {
  public:
    void push(const Pair& pair) {
        const std::size_t bucket = bucket_of(pair);
        buckets_[bucket].push_back(pair);
        std::push_heap(buckets_[bucket].begin(), buckets_[bucket].end(), std::greater<>());
        lowest_ = std::min(lowest_, bucket);
    }

    // The least of those that `is_alive`, taken out; nothing when there are none.
    template <typename IsAlive>
    std::optional<Pair> pop(const IsAlive& is_alive) {
        for (; lowest_ < buckets_.size(); ++lowest_) {
            std::vector<Pair>& bucket = buckets_[lowest_];
            while (!bucket.empty()) {
                std::pop_heap(bucket.begin(), bucket.end(), std::greater<>());
                const Pair pair = bucket.back();
                bucket.pop_back();
                if (is_alive(pair)) return pair;
            }
        }
        return std::nullopt;
    }

  private:
    static constexpr std::size_t kBuckets = 4096;
    static std::size_t bucket_of(const Pair& pair) {
        return std::min(static_cast<std::size_t>(pair.distance * kBuckets), kBuckets - 1);
    }

    std::vector<std::vector<Pair>> buckets_ = std::vector<std::vector<Pair>>(kBuckets);
    std::size_t lowest_ = kBuckets;  // none before it holds any
};

struct Cluster {
    Cluster(const DVec3& center_sum, double ranges, double members)
        : sum(center_sum),
          range_sum(ranges),
          count(members),
          center(sum / count),
          range(range_sum / count) {}

    DVec3 sum;
    double range_sum;
    double count;
    DVec3 center;
    double range;
    std::vector<std::uint32_t> neighbours;  // may name clusters that have been merged since
    std::uint32_t merged_into = kNone;
};

class Merger {
  public:
    Merger(std::span<const Vec3> points, std::span<const glm::uvec2> links,
           std::span<const float> ranges) {
        clusters_.reserve(points.size() * 2);
        merged_as_.assign(points.size() * 2, kNone);
        for (std::size_t i = 0; i < points.size(); ++i) {
            clusters_.emplace_back(DVec3(points[i]), static_cast<double>(ranges[i]), 1.0);
        }
        for (const glm::uvec2& link : links) {
            clusters_[link.x].neighbours.push_back(link.y);
            clusters_[link.y].neighbours.push_back(link.x);
            if (const auto pair = pair_of(link.x, link.y)) queue_.push(*pair);
        }
    }

    void run() {
        const auto is_alive = [&](const Pair& pair) {
            return clusters_[pair.a].merged_into == kNone && clusters_[pair.b].merged_into == kNone;
        };
        while (const std::optional<Pair> pair = queue_.pop(is_alive)) merge(pair->a, pair->b);
    }

    // Halves the way on its way, so that long chains of mergers are walked once.
    std::uint32_t survivor(std::uint32_t cluster) {
        while (clusters_[cluster].merged_into != kNone) {
            const std::uint32_t next = clusters_[cluster].merged_into;
            const std::uint32_t after = clusters_[next].merged_into;
            if (after == kNone) return next;
            clusters_[cluster].merged_into = after;
            cluster = after;
        }
        return cluster;
    }

    const Cluster& at(std::uint32_t cluster) const { return clusters_[cluster]; }

  private:
    // Two clusters that are near enough to become one.
    std::optional<Pair> pair_of(std::uint32_t a, std::uint32_t b) const {
        const double distance = glm::distance(clusters_[a].center, clusters_[b].center);
        const double range = std::min(clusters_[a].range, clusters_[b].range);
        if (distance > range) return std::nullopt;
        return Pair{range > 0.0 ? distance / range : 0.0, std::min(a, b), std::max(a, b)};
    }

    // A merged pair gets a new name, so that entries in the queue for its parts are known to be
    // stale.
    void merge(std::uint32_t a, std::uint32_t b) {
        const auto name = static_cast<std::uint32_t>(clusters_.size());
        Cluster merged(clusters_[a].sum + clusters_[b].sum,
                       clusters_[a].range_sum + clusters_[b].range_sum,
                       clusters_[a].count + clusters_[b].count);
        merged_as_[a] = merged_as_[b] = name;
        for (const std::uint32_t part : {a, b}) {
            for (const std::uint32_t n : clusters_[part].neighbours) {
                const std::uint32_t living = survivor(n);
                if (merged_as_[living] == name) continue;
                merged_as_[living] = name;
                merged.neighbours.push_back(living);
            }
        }
        for (const std::uint32_t part : {a, b}) {
            clusters_[part].merged_into = name;
            clusters_[part].neighbours = {};
        }
        clusters_.push_back(std::move(merged));
        for (const std::uint32_t n : clusters_[name].neighbours) {
            clusters_[n].neighbours.push_back(name);
            if (const auto pair = pair_of(name, n)) queue_.push(*pair);
        }
    }

    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> merged_as_;  // the last merger that listed a cluster
    PairQueue queue_;
};

}  // namespace

Clusters cluster_minima(std::span<const Vec3> points, std::span<const glm::uvec2> links,
                        std::span<const float> ranges) {
    Merger merger(points, links, ranges);
    merger.run();
    Clusters out;
    out.of_point.resize(points.size());
    std::vector<std::uint32_t> number(points.size() * 2, kNone);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const std::uint32_t cluster = merger.survivor(p);
        if (number[cluster] == kNone) {
            number[cluster] = static_cast<std::uint32_t>(out.centers.size());
            out.centers.emplace_back(merger.at(cluster).center);
        }
        out.of_point[p] = number[cluster];
    }
    return out;
}

Clusters cluster_minima(std::span<const Vec3> points, std::span<const glm::uvec2> links,
                        const ClusterOptions& options) {
    const std::vector<float> ranges(points.size(), static_cast<float>(options.range_world));
    return cluster_minima(points, links, ranges);
}

}  // namespace zskel
