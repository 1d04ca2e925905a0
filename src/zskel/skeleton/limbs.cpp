#include "zskel/skeleton/limbs.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <queue>
#include <utility>

#include "zskel/skeleton/girth.h"

namespace zskel {
namespace {

struct Arc {
    std::uint32_t to;
    std::uint32_t connection;
};

class LimbGrower {
  public:
    LimbGrower(const ClusterContext& context, const ClusterNetwork& network,
               const LimbOptions& options)
        : context_(context),
          connections_(network.connections),
          clusters_(context.clusters),
          girths_(girths_at(context.query, context.clusters.centers)),
          options_(options),
          arcs_(girths_.size()),
          cost_(girths_.size(), kInfinity),
          way_(girths_.size(), {kNone, kNone}),
          root_(girths_.size(), kNone),
          reach_(girths_.size(), 0.0f),
          trunk_(girths_.size(), 0.0f),
          is_kept_(girths_.size(), false),
          beyond_(context.spread.vertices.size(), kInfinity),
          is_rejected_(context.spread.vertices.size(), false) {
        for (const std::uint32_t v : context.spread.vertices) {
            seed_points_.push_back(context.surface.positions[v]);
            seed_starts_.push_back(context.inner[v]);
        }
        for (std::uint32_t i = 0; i < connections_.size(); ++i) {
            arcs_[connections_[i].a].push_back({connections_[i].b, i});
            arcs_[connections_[i].b].push_back({connections_[i].a, i});
        }
    }

    Limbs run(std::span<const std::uint32_t> spanning) {
        keep_core(spanning);
        while (true) {
            const std::uint32_t seed = farthest_out();
            if (seed == kNone) break;
            try_limb(seed);
        }
        out_.home.resize(girths_.size());
        for (std::uint32_t c = 0; c < girths_.size(); ++c) out_.home[c] = way_to_kept(c).back();
        return std::move(out_);
    }

  private:
    // What is left of the spanning network when dead ends are taken off, but for the thickest
    // cluster of each part.
    void keep_core(std::span<const std::uint32_t> spanning) {
        std::vector<std::vector<Arc>> links(girths_.size());
        for (const std::uint32_t i : spanning) {
            links[connections_[i].a].push_back({connections_[i].b, i});
            links[connections_[i].b].push_back({connections_[i].a, i});
        }
        std::vector<bool> is_root(girths_.size(), false);
        mark_roots(links, is_root);
        std::vector<bool> is_gone(girths_.size(), false);
        std::vector<std::size_t> degree(girths_.size());
        std::vector<std::uint32_t> loose;
        for (std::uint32_t c = 0; c < girths_.size(); ++c) {
            degree[c] = links[c].size();
            if (degree[c] <= 1 && !is_root[c]) loose.push_back(c);
        }
        while (!loose.empty()) {
            const std::uint32_t c = loose.back();
            loose.pop_back();
            is_gone[c] = true;
            for (const Arc& arc : links[c]) {
                if (!is_gone[arc.to] && --degree[arc.to] == 1 && !is_root[arc.to])
                    loose.push_back(arc.to);
            }
        }
        for (const std::uint32_t i : spanning) {
            if (!is_gone[connections_[i].a] && !is_gone[connections_[i].b])
                out_.connections.push_back(i);
        }
        std::vector<std::uint32_t> kept;
        for (std::uint32_t c = 0; c < girths_.size(); ++c) {
            if (!is_gone[c]) kept.push_back(c);
        }
        keep(kept);
        for (const std::uint32_t i : out_.connections) {
            const Connection& c = connections_[i];
            cover(c.path, girths_[c.a], girths_[c.b]);
        }
    }

    void mark_roots(const std::vector<std::vector<Arc>>& links, std::vector<bool>& is_root) const {
        std::vector<bool> seen(links.size(), false);
        for (std::uint32_t first = 0; first < links.size(); ++first) {
            if (seen[first]) continue;
            std::vector<std::uint32_t> part{first};
            seen[first] = true;
            std::uint32_t thickest = first;
            for (std::size_t i = 0; i < part.size(); ++i) {
                if (girths_[part[i]] > girths_[thickest]) thickest = part[i];
                for (const Arc& arc : links[part[i]]) {
                    if (seen[arc.to]) continue;
                    seen[arc.to] = true;
                    part.push_back(arc.to);
                }
            }
            is_root[thickest] = true;
        }
    }

    // Kept clusters cost nothing to reach; the ways to them are found anew where they got shorter.
    void keep(const std::vector<std::uint32_t>& kept) {
        using Entry = std::pair<float, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        for (const std::uint32_t c : kept) {
            constexpr float alpha = 0.8f;
            is_kept_[c] = true;
            cost_[c] = alpha * trunk_[c];
            way_[c] = {c, kNone};
            root_[c] = c;
            reach_[c] = 0.0f;
            front.emplace(cost_[c], c);
            cover(clusters_.centers[c], clusters_.centers[c], girths_[c], girths_[c]);
        }
        while (!front.empty()) {
            const auto [cost, c] = front.top();
            front.pop();
            if (cost > cost_[c]) continue;
            for (const Arc& arc : arcs_[c]) {
                const float there = cost + cost_of(connections_[arc.connection]);
                if (is_kept_[arc.to] || there >= cost_[arc.to]) continue;
                cost_[arc.to] = there;
                way_[arc.to] = {c, arc.connection};
                root_[arc.to] = root_[c];
                reach_[arc.to] = reach_[c] + connections_[arc.connection].length;
                front.emplace(there, arc.to);
            }
        }
    }

    // Length in local radii, so that ways run along the thick middle.
    float cost_of(const Connection& c) const {
        const float radius = std::max(0.5f * (girths_[c.a] + girths_[c.b]), 1e-6f);
        return c.length / radius * (c.is_inside ? 1.0f : 1e3f);
    }

    // How far a seed's place sticks out of the balls that see it; of those that none sees, what
    // the way to it is longer than the ball that it begins in.
    float sticking_out(std::uint32_t seed) const {
        if (is_rejected_[seed]) return -kInfinity;
        const std::uint32_t c = clusters_.of_point[seed];
        if (way_[c].first == kNone) return -kInfinity;
        const float along = reach_[c] + glm::distance(seed_points_[seed], clusters_.centers[c]);
        return std::min(beyond_[seed], along - girths_[root_[c]]);
    }

    // The balls along a path whose radius goes evenly from one end's to the other's.
    void cover(std::span<const Vec3> path, float first_radius, float last_radius) {
        float length = 0.0f;
        for (std::size_t i = 1; i < path.size(); ++i) length += glm::distance(path[i - 1], path[i]);
        float passed = 0.0f;
        for (std::size_t i = 1; i < path.size(); ++i) {
            const float piece = glm::distance(path[i - 1], path[i]);
            const auto radius_at = [&](float along) {
                return glm::mix(first_radius, last_radius, length > 0.0f ? along / length : 0.0f);
            };
            cover(path[i - 1], path[i], radius_at(passed), radius_at(passed + piece));
            passed += piece;
        }
    }

    void cover(const Vec3& a, const Vec3& b, float radius_a, float radius_b) {
        const Vec3 along = b - a;
        const float square = glm::dot(along, along);
        for (std::size_t s = 0; s < beyond_.size(); ++s) {
            const float t =
                square > 0.0f
                    ? glm::clamp(glm::dot(seed_points_[s] - a, along) / square, 0.0f, 1.0f)
                    : 0.0f;
            const Vec3 nearest = a + along * t;
            const float beyond =
                glm::distance(seed_points_[s], nearest) - glm::mix(radius_a, radius_b, t);
            if (beyond < beyond_[s] && !context_.query.first_hit(nearest, seed_starts_[s]))
                beyond_[s] = beyond;
        }
    }

    std::uint32_t farthest_out() const {
        std::uint32_t best = kNone;
        float most = 0.0f;
        for (std::uint32_t s = 0; s < beyond_.size(); ++s) {
            const float out = sticking_out(s);
            if (out > most) {
                most = out;
                best = s;
            }
        }
        return best;
    }

    std::vector<std::uint32_t> way_to_kept(std::uint32_t cluster) const {
        std::vector<std::uint32_t> way{cluster};
        while (way_[way.back()].first != way.back()) {
            if (way_[way.back()].first == kNone) break;
            way.push_back(way_[way.back()].first);
        }
        return way;
    }

    // From a cluster outwards along the way that a seed came, to the centre of the last ball that
    // touches the seed's place; empty where the cluster is near that place already, or the way is not free.
    std::vector<Vec3> tip_of(std::uint32_t cluster, std::uint32_t seed) const {
        const Vec3& center = clusters_.centers[cluster];
        const Vec3& goal = seed_points_[seed];
        if (glm::distance(center, goal) < 1.5f * girths_[cluster]) return {};
        const std::vector<Vec3>& came = context_.settled[seed].path;
        std::vector<Vec3> path{center};
        path.insert(path.end(), came.rbegin(), came.rend());
        path = pull_tight(path, context_.query);
        if (!is_free(path, context_.query)) return {};
        std::vector<Vec3> tip{center};
        for (std::size_t i = 1; i < path.size(); ++i) {
            constexpr int kPieces = 8;
            for (int k = 1; k <= kPieces; ++k) {
                const Vec3 p = glm::mix(path[i - 1], path[i], static_cast<float>(k) / kPieces);
                tip.push_back(p);
            }
        }
        while (tip.size() > 1 && context_.query.nearest(tip.back()).distance >
                                     0.9f * glm::distance(tip.back(), goal))
            tip.pop_back();
        if (tip.size() < 2) return {};
        return tip;
    }

    void try_limb(std::uint32_t seed) {
        std::vector<std::uint32_t> way = way_to_kept(clusters_.of_point[seed]);
        const std::vector<Vec3> tip = tip_of(way.front(), seed);
        const std::vector<float> tip_girths = girths_at(context_.query, tip);
        if (!is_limb(way, tip, tip_girths, static_cast<double>(sticking_out(seed)))) {
            is_rejected_[seed] = true;
            ++out_.rejected;
            return;
        }
        ++out_.limbs;
        for (std::size_t i = way.size() - 1; i-- > 0;)
            trunk_[way[i]] = trunk_[way[i + 1]] + cost_of(connections_[way_[way[i]].second]);
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            const Connection& c = connections_[way_[way[i]].second];
            out_.connections.push_back(way_[way[i]].second);
            cover(c.path, girths_[c.a], girths_[c.b]);
        }
        for (std::size_t i = 1; i < tip.size(); ++i)
            cover(tip[i - 1], tip[i], tip_girths[i - 1], tip_girths[i]);
        if (!tip.empty()) out_.tips.push_back({way.front(), tip});
        way.pop_back();
        keep(way);
        is_rejected_[seed] = true;
    }

    // The limb's own girth is that of what lies outside the ball that it grows from.
    bool is_limb(const std::vector<std::uint32_t>& way, const std::vector<Vec3>& tip,
                 const std::vector<float>& tip_girths, double beyond) const {
        const Vec3& root = clusters_.centers[way.back()];
        const float junction = girths_[way.back()];
        double length = 0.0;
        double outside = 0.0;
        double girth_outside = 0.0;
        const auto add = [&](float piece, const Vec3& end, float girth) {
            length += static_cast<double>(piece);
            if (glm::distance(end, root) <= junction) return;
            outside += static_cast<double>(piece);
            girth_outside += static_cast<double>(piece * girth);
        };
        for (std::size_t i = 0; i + 1 < way.size(); ++i)
            add(connections_[way_[way[i]].second].length, clusters_.centers[way[i]],
                girths_[way[i]]);
        for (std::size_t i = 1; i < tip.size(); ++i)
            add(glm::distance(tip[i - 1], tip[i]), tip[i], tip_girths[i]);
        if (!(outside > 0.0)) return false;
        const double own_measure = beyond * outside / girth_outside;
        const double junction_measure = beyond / static_cast<double>(junction);
        const double length_measure = length / static_cast<double>(junction);
        const bool ok=beyond>=options_.detail*0.02&&own_measure >= options_.detail * (tip.empty()?1.3:2.5) &&
               junction_measure >= options_.detail * 0.4 && own_measure*junction_measure >= options_.detail * 0.9&&
               length_measure >= options_.detail * options_.least_length_radii;
        if (getenv("LIMBS") && own_measure >= 1 && junction_measure > 0.3)
            fprintf(stderr, "limb %.4f own %.2f junction %.2f length %.2f tip %zu way %zu %c\n", beyond, own_measure, junction_measure,length_measure, tip.size(), way.size(),ok?'Y':'n');
        return ok;
    }

    const ClusterContext& context_;
    std::span<const Connection> connections_;
    const Clusters& clusters_;
    std::vector<float> girths_;
    std::vector<Vec3> seed_points_;
    std::vector<Vec3> seed_starts_;
    const LimbOptions& options_;
    std::vector<std::vector<Arc>> arcs_;
    std::vector<float> cost_;  // to the nearest kept cluster
    std::vector<std::pair<std::uint32_t, std::uint32_t>> way_;  // next cluster, over which connection
    std::vector<std::uint32_t> root_;  // the kept cluster where the way ends
    std::vector<float> reach_;         // length of the way
    std::vector<float> trunk_;         // of kept clusters: cost on to the core
    std::vector<bool> is_kept_;
    std::vector<float> beyond_;        // of every seed: how far its surface point sticks out
    std::vector<bool> is_rejected_;
    Limbs out_;
};

}  // namespace

Limbs grow_limbs(const ClusterContext& context, const ClusterNetwork& network,
                 const LimbOptions& options) {
    return LimbGrower(context, network, options).run(network.spanning);
}

}  // namespace zskel
