#include "zskel/skeleton/limbs.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <queue>
#include <utility>

namespace zskel {
namespace {

struct Arc {
    std::uint32_t to;
    std::uint32_t connection;
};

class LimbGrower {
  public:
    LimbGrower(std::span<const Connection> connections, const Clusters& clusters,
               std::span<const float> radii, std::span<const Vec3> seed_points,
               const LimbOptions& options)
        : connections_(connections),
          clusters_(clusters),
          radii_(radii),
          seed_points_(seed_points),
          options_(options),
          arcs_(radii.size()),
          cost_(radii.size(), kInfinity),
          way_(radii.size(), {kNone, kNone}),
          beyond_(seed_points.size(), kInfinity) {
        for (std::uint32_t i = 0; i < connections.size(); ++i) {
            arcs_[connections[i].a].push_back({connections[i].b, i});
            arcs_[connections[i].b].push_back({connections[i].a, i});
        }
    }

    Limbs run(std::span<const std::uint32_t> spanning) {
        keep_core(spanning);
        while (true) {
            const std::uint32_t seed = farthest_out();
            if (seed == kNone) break;
            try_limb(seed);
        }
        out_.home.resize(radii_.size());
        for (std::uint32_t c = 0; c < radii_.size(); ++c) out_.home[c] = way_to_kept(c).back();
        return std::move(out_);
    }

  private:
    // What is left of the spanning network when dead ends are taken off, but for the thickest
    // cluster of each part.
    void keep_core(std::span<const std::uint32_t> spanning) {
        std::vector<std::vector<Arc>> links(radii_.size());
        for (const std::uint32_t i : spanning) {
            links[connections_[i].a].push_back({connections_[i].b, i});
            links[connections_[i].b].push_back({connections_[i].a, i});
        }
        std::vector<bool> is_root(radii_.size(), false);
        mark_roots(links, is_root);
        std::vector<bool> is_gone(radii_.size(), false);
        std::vector<std::size_t> degree(radii_.size());
        std::vector<std::uint32_t> loose;
        for (std::uint32_t c = 0; c < radii_.size(); ++c) {
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
        for (std::uint32_t c = 0; c < radii_.size(); ++c) {
            if (!is_gone[c]) kept.push_back(c);
        }
        keep(kept);
        for (const std::uint32_t i : out_.connections) {
            const Connection& c = connections_[i];
            cover(c.path, radii_[c.a], radii_[c.b]);
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
                if (radii_[part[i]] > radii_[thickest]) thickest = part[i];
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
            cost_[c] = 0.0f;
            way_[c] = {c, kNone};
            front.emplace(0.0f, c);
            cover(clusters_.centers[c], clusters_.centers[c], radii_[c], radii_[c]);
        }
        while (!front.empty()) {
            const auto [cost, c] = front.top();
            front.pop();
            if (cost > cost_[c]) continue;
            for (const Arc& arc : arcs_[c]) {
                const float there = cost + cost_of(connections_[arc.connection]);
                if (there >= cost_[arc.to]) continue;
                cost_[arc.to] = there;
                way_[arc.to] = {c, arc.connection};
                front.emplace(there, arc.to);
            }
        }
    }

    // Length in local radii, so that ways run along the thick middle.
    float cost_of(const Connection& c) const {
        const float radius = std::max(0.5f * (radii_[c.a] + radii_[c.b]), 1e-6f);
        return c.length / radius * (c.is_inside ? 1.0f : 1e3f);
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
            const float distance = glm::distance(seed_points_[s], a + along * t);
            beyond_[s] = std::min(beyond_[s], distance - glm::mix(radius_a, radius_b, t));
        }
    }

    std::uint32_t farthest_out() const {
        std::uint32_t best = kNone;
        for (std::uint32_t s = 0; s < beyond_.size(); ++s) {
            if (beyond_[s] > 0.0f && (best == kNone || beyond_[s] > beyond_[best])) best = s;
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

    void try_limb(std::uint32_t seed) {
        const std::vector<std::uint32_t> way = way_to_kept(clusters_.of_point[seed]);
        if (!is_limb(way, static_cast<double>(beyond_[seed]))) {
            beyond_[seed] = -kInfinity;
            ++out_.rejected;
            return;
        }
        ++out_.limbs;
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            const Connection& c = connections_[way_[way[i]].second];
            out_.connections.push_back(way_[way[i]].second);
            cover(c.path, radii_[c.a], radii_[c.b]);
        }
        keep(way);
        beyond_[seed] = -kInfinity;
    }

    bool is_limb(const std::vector<std::uint32_t>& way, double beyond) const {
        if (way.size() < 2) return false;
        const auto junction = static_cast<double>(radii_[way.back()]);
        double own = 0.0;
        double length = 0.0;
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            length += static_cast<double>(connections_[way_[way[i]].second].length);
            own += static_cast<double>(radii_[way[i]]) / static_cast<double>(way.size() - 1);
        }
        if (getenv("LIMBS"))
            fprintf(stderr, "limb beyond %.4f own %.4f (%.2f) junction %.4f (%.2f) length %.4f (%.2f)\n",
                    beyond, own, beyond / own, junction, beyond / junction, length,
                    length / junction);
        return beyond >= options_.detail * options_.least_own_radii * own &&
               beyond >= options_.detail * options_.least_junction_radii * junction &&
               length >= options_.detail * options_.least_length_radii * junction;
    }

    std::span<const Connection> connections_;
    const Clusters& clusters_;
    std::span<const float> radii_;
    std::span<const Vec3> seed_points_;
    const LimbOptions& options_;
    std::vector<std::vector<Arc>> arcs_;
    std::vector<float> cost_;  // to the nearest kept cluster
    std::vector<std::pair<std::uint32_t, std::uint32_t>> way_;  // next cluster, over which connection
    std::vector<float> beyond_;  // of every seed: how far its surface point sticks out
    Limbs out_;
};

}  // namespace

Limbs grow_limbs(std::span<const Connection> connections, std::span<const std::uint32_t> spanning,
                 const Clusters& clusters, std::span<const float> cluster_radii,
                 std::span<const Vec3> seed_points, const LimbOptions& options) {
    return LimbGrower(connections, clusters, cluster_radii, seed_points, options).run(spanning);
}

}  // namespace zskel
