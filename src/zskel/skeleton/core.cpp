#include "zskel/skeleton/core.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/parallel.h"

namespace zskel {
namespace {

constexpr int kRounds = 3;          // in which each way is tried once
constexpr float kLeastGain = 0.1f;  // share of its cost
constexpr int kPieces = 3;          // that each straight of a connection is measured in
// Of the cost along the rest of the core: ways leave it at acute angles.
constexpr float kSlideShare = 0.8f;
// Places that a search may come to, and all of them together: some 1.5 s.
constexpr std::size_t kMostPlacesOfWay = 20'000;
constexpr std::size_t kMostPlaces = 1'000'000;

// Between two clusters at which more or less than two connections of the core meet, or round from
// one to itself.
struct Strand {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::vector<std::uint32_t> connections;
    std::uint64_t sum = 0;
    float cost = 0.0f;
};

class CoreLayer {
  public:
    CoreLayer(const SurfaceQuery& query, std::span<const float> girths,
              std::span<const Connection> connections, std::span<const std::uint32_t> core)
        : connections_(connections),
          girths_(girths),
          costs_(connections.size()),
          arcs_(arcs_of(connections, girths.size())) {
        parallel_for(connections.size(), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                costs_[i] = radii_along(connections[i].path, query);
        });
        set_core(core);
        cycles_ = count_cycles();
    }

    LaidCore run() {
        for (int round = 0; round < kRounds; ++round) {
            bool is_changed = false;
            for (const Strand& strand : strands()) {
                if (!is_whole(strand)) continue;
                const std::vector<std::uint32_t> way = cheaper_way(strand);
                if (!way.empty() && replace(strand, way)) is_changed = true;
            }
            if (!is_changed) break;
        }
        return {core_, is_complete_};
    }

  private:
    // Where a search has come to: on the rest of the core before it left it, off it, or on it
    // again.
    enum class Phase : std::uint8_t { Before, Off, After };
    using State = std::tuple<std::uint32_t, std::uint64_t, Phase>;
    struct Reached {
        float cost;
        State before;
        std::uint32_t by = kNone;  // connection
    };

    static float radii_along(std::span<const Vec3> path, const SurfaceQuery& query) {
        float sum = 0.0f;
        for (std::size_t i = 1; i < path.size(); ++i) {
            const float piece = glm::distance(path[i - 1], path[i]) / kPieces;
            for (int k = 0; k < kPieces; ++k) {
                const float share = (static_cast<float>(k) + 0.5f) / kPieces;
                const Vec3 place = glm::mix(path[i - 1], path[i], share);
                sum += piece / std::max(query.nearest(place).distance, 1e-6f);
            }
        }
        return sum;
    }

    void set_core(std::span<const std::uint32_t> core) {
        core_.assign(core.begin(), core.end());
        in_core_.assign(connections_.size(), false);
        for (const std::uint32_t i : core_) in_core_[i] = true;
        core_arcs_ = arcs_of(connections_, core_, girths_.size());
    }

    std::uint64_t sum_from(std::uint32_t cluster, std::uint32_t connection) const {
        const Connection& c = connections_[connection];
        return c.a == cluster ? c.sum : 0 - c.sum;
    }

    // Rings without a junction start at their thickest cluster.
    std::vector<Strand> strands() const {
        std::vector<std::uint32_t> starts(core_arcs_.size());
        std::iota(starts.begin(), starts.end(), 0u);
        std::stable_sort(starts.begin(), starts.end(), [&](std::uint32_t l, std::uint32_t r) {
            return std::pair(core_arcs_[l].size() == 2, -girths_[l]) <
                   std::pair(core_arcs_[r].size() == 2, -girths_[r]);
        });
        std::vector<Strand> out;
        std::vector<bool> is_seen(connections_.size(), false);
        for (const std::uint32_t start : starts) {
            for (const Arc& first : core_arcs_[start]) {
                if (is_seen[first.connection]) continue;
                out.push_back(strand_from(start, first));
                for (const std::uint32_t i : out.back().connections) is_seen[i] = true;
            }
        }
        return out;
    }

    Strand strand_from(std::uint32_t start, const Arc& first) const {
        Strand out{start, start, {}, 0, 0.0f};
        Arc next = first;
        while (true) {
            out.sum += sum_from(out.to, next.connection);
            out.cost += costs_[next.connection];
            out.connections.push_back(next.connection);
            out.to = next.to;
            const std::vector<Arc>& arcs = core_arcs_[out.to];
            if (arcs.size() != 2 || out.to == start) return out;
            next = arcs[0].connection == next.connection ? arcs[1] : arcs[0];
        }
    }

    // Nothing of it has been replaced, and nothing new ends on it.
    bool is_whole(const Strand& strand) const {
        std::uint32_t at = strand.from;
        for (const std::uint32_t i : strand.connections) {
            if (!in_core_[i] || (at != strand.from && core_arcs_[at].size() != 2)) return false;
            at = connections_[i].a == at ? connections_[i].b : connections_[i].a;
        }
        return true;
    }

    // The connections off the rest of the core; none where no way costs less.
    std::vector<std::uint32_t> cheaper_way(const Strand& strand) {
        std::vector<bool> is_strand(connections_.size(), false);
        for (const std::uint32_t i : strand.connections) is_strand[i] = true;
        const auto is_rest = [&](std::uint32_t i) { return in_core_[i] && !is_strand[i]; };
        const auto on_rest = [&](std::uint32_t cluster) {
            return cluster == strand.from || cluster == strand.to ||
                   std::ranges::any_of(core_arcs_[cluster],
                                       [&](const Arc& arc) { return is_rest(arc.connection); });
        };
        const float most = (1.0f - kLeastGain) * strand.cost;
        const State start{strand.from, 0, Phase::Before};
        const State goal{strand.to, strand.sum, Phase::After};
        using Entry = std::pair<float, State>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        std::map<State, Reached> reached{{start, {0.0f, start, kNone}}};
        front.emplace(0.0f, start);
        const std::size_t most_places = std::min(kMostPlacesOfWay, places_left_);
        std::vector<std::uint32_t> way;
        while (!front.empty()) {
            const auto [cost, state] = front.top();
            front.pop();
            if (cost > reached.at(state).cost) continue;
            if (state == goal) {
                way = way_to(goal, start, reached, is_rest);
                break;
            }
            if (reached.size() >= most_places) {
                is_complete_ = false;
                break;
            }
            const auto [cluster, sum, phase] = state;
            for (const Arc& arc : arcs_[cluster]) {
                const Connection& c = connections_[arc.connection];
                if (c.a == c.b || !c.is_inside) continue;
                const bool slides = is_rest(arc.connection);
                if (slides ? phase == Phase::Off : phase == Phase::After) continue;
                const float there = cost + (slides ? kSlideShare : 1.0f) * costs_[arc.connection];
                if (there >= most) continue;
                const Phase then = slides ? phase : on_rest(arc.to) ? Phase::After : Phase::Off;
                const State next{arc.to, sum + sum_from(cluster, arc.connection), then};
                const auto [known, is_new] = reached.try_emplace(next, Reached{kInfinity, {}, 0});
                if (there >= known->second.cost) continue;
                known->second = {there, state, arc.connection};
                front.emplace(there, next);
            }
        }
        places_left_ -= std::min(places_left_, reached.size());
        return way;
    }

    template <typename IsRest>
    static std::vector<std::uint32_t> way_to(State at, const State& start,
                                             const std::map<State, Reached>& reached,
                                             const IsRest& is_rest) {
        std::vector<std::uint32_t> way;
        for (; at != start; at = reached.at(at).before) {
            const std::uint32_t by = reached.at(at).by;
            if (!is_rest(by)) way.push_back(by);
        }
        return way;
    }

    // Undone where the way is none that the strand can give place to: it goes through a cluster
    // twice, or the strand's cycle is none in the solid.
    bool replace(const Strand& strand, const std::vector<std::uint32_t>& way) {
        const std::vector<std::uint32_t> before = core_;
        for (const std::uint32_t i : strand.connections) in_core_[i] = false;
        for (const std::uint32_t i : way) in_core_[i] = true;
        std::vector<std::uint32_t> core;
        for (std::uint32_t i = 0; i < connections_.size(); ++i) {
            if (in_core_[i]) core.push_back(i);
        }
        set_core(core_of(connections_, core, girths_.size()));
        if (count_cycles() == cycles_) return true;
        set_core(before);
        return false;
    }

    std::size_t count_cycles() const {
        DisjointSets sets(girths_.size());
        return static_cast<std::size_t>(std::ranges::count_if(core_, [&](std::uint32_t i) {
            return !sets.unite(connections_[i].a, connections_[i].b);
        }));
    }

    std::span<const Connection> connections_;
    std::span<const float> girths_;
    std::vector<float> costs_;
    Arcs arcs_;
    std::vector<std::uint32_t> core_;
    std::vector<bool> in_core_;
    Arcs core_arcs_;
    std::size_t cycles_ = 0;
    std::size_t places_left_ = kMostPlaces;
    bool is_complete_ = true;
};

}  // namespace

Arcs arcs_of(std::span<const Connection> connections, std::size_t clusters) {
    std::vector<std::uint32_t> all(connections.size());
    std::iota(all.begin(), all.end(), 0u);
    return arcs_of(connections, all, clusters);
}

Arcs arcs_of(std::span<const Connection> connections, std::span<const std::uint32_t> numbers,
             std::size_t clusters) {
    Arcs arcs(clusters);
    for (const std::uint32_t i : numbers) {
        arcs[connections[i].a].push_back({connections[i].b, i});
        arcs[connections[i].b].push_back({connections[i].a, i});
    }
    return arcs;
}

std::vector<std::uint32_t> core_of(std::span<const Connection> connections,
                                   std::span<const std::uint32_t> numbers, std::size_t clusters) {
    const Arcs arcs = arcs_of(connections, numbers, clusters);
    std::vector<std::size_t> degree;
    std::vector<std::uint32_t> loose;
    for (std::uint32_t c = 0; c < clusters; ++c) {
        degree.push_back(arcs[c].size());
        if (degree[c] == 1) loose.push_back(c);
    }
    std::vector<bool> is_left(clusters, true);
    while (!loose.empty()) {
        const std::uint32_t c = loose.back();
        loose.pop_back();
        is_left[c] = false;
        for (const Arc& arc : arcs[c]) {
            if (is_left[arc.to] && --degree[arc.to] == 1) loose.push_back(arc.to);
        }
    }
    std::vector<std::uint32_t> core;
    for (const std::uint32_t i : numbers) {
        if (is_left[connections[i].a] && is_left[connections[i].b]) core.push_back(i);
    }
    return core;
}

LaidCore lay_core(const SurfaceQuery& query, std::span<const float> girths,
                  std::span<const Connection> connections, std::span<const std::uint32_t> core) {
    return CoreLayer(query, girths, connections, core).run();
}

}  // namespace zskel
