#include "zskel/skeleton/limbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "zskel/skeleton/core.h"
#include "zskel/skeleton/coverage.h"
#include "zskel/skeleton/far_patches.h"
#include "zskel/skeleton/girth.h"
#include "zskel/skeleton/path.h"
#include "zskel/skeleton/section.h"

namespace zskel {
namespace {

// The part of the cost from where a limb joins on to the core that counts in where it joins: limbs
// join at acute angles, as they would not if they took the shortest way to the next branch.
constexpr float kTrunkShare = 0.8f;
constexpr float kNearTipGirths = 1.5f;  // a cluster so near to a seed's place needs no way on to it
constexpr float kLastBallShare = 0.9f;  // a ball touches a place when it reaches so far towards it
constexpr int kTipPieces = 8;           // that each straight of a tip is looked at in
constexpr int kLimbPieces = 64;  // that a limb is looked at in, for where it leaves the body,
constexpr std::size_t kOutsidePlaces = 8;  // and places outside, for how thick it is
constexpr float kUnfreeCost = 1e3f;        // of connections that could not be laid inside
constexpr float kDetour = 3.0f;  // a way so many times as long as straight across a ball is one
// Of the thickest cluster: those that count as thick as it where limbs begin to grow, and where
// none has grown.
constexpr float kAsThick = 0.98f;
constexpr float kAsThickAlone = 0.95f;

float median(std::vector<float> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

double mean(const std::vector<float>& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0) /
           static_cast<double>(numbers.size());
}

// Of some clusters the thickest; of several as thick, as a plate has, the one in their middle.
std::uint32_t thickest_in(std::span<const std::uint32_t> part, float as_thick,
                          std::span<const float> girths, std::span<const Vec3> centers) {
    float most = 0.0f;
    for (const std::uint32_t c : part) most = std::max(most, girths[c]);
    std::vector<std::uint32_t> thick;
    DVec3 middle(0.0);
    for (const std::uint32_t c : part) {
        if (girths[c] < as_thick * most) continue;
        thick.push_back(c);
        middle += DVec3(centers[c]);
    }
    middle /= static_cast<double>(thick.size());
    return *std::ranges::min_element(
        thick, {}, [&](std::uint32_t c) { return glm::distance(DVec3(centers[c]), middle); });
}

// The thickest cluster of each part of a network that has no cycle.
std::vector<bool> thickest_of(const Arcs& arcs, std::span<const float> girths,
                              std::span<const Vec3> centers) {
    std::vector<bool> is_thickest(arcs.size(), false);
    std::vector<bool> seen(arcs.size(), false);
    for (std::uint32_t first = 0; first < arcs.size(); ++first) {
        if (seen[first]) continue;
        std::vector<std::uint32_t> part{first};
        seen[first] = true;
        std::size_t ends = 0;  // of connections
        for (std::size_t i = 0; i < part.size(); ++i) {
            ends += arcs[part[i]].size();
            for (const Arc& arc : arcs[part[i]]) {
                if (seen[arc.to]) continue;
                seen[arc.to] = true;
                part.push_back(arc.to);
            }
        }
        is_thickest[thickest_in(part, kAsThick, girths, centers)] = ends / 2 < part.size();
    }
    return is_thickest;
}

class LimbGrower {
  public:
    LimbGrower(const ClusterContext& context, const ClusterNetwork& network,
               const LimbOptions& options)
        : context_(context),
          connections_(network.connections),
          centers_(context.clusters.centers),
          girths_(context.girths),
          options_(options),
          arcs_(arcs_of(connections_, girths_.size())),
          ways_(girths_.size()),
          coverage_(seed_coverage(context)),
          is_tried_(context.spread.vertices.size(), false) {}

    Limbs run(const ClusterNetwork& network) {
        keep_core(network);
        for (std::uint32_t seed = farthest_out(); seed != kNone; seed = farthest_out())
            try_limb(seed);
        grow_fat_ends();
        for (std::uint32_t c = 0; c < girths_.size(); ++c)
            out_.home.push_back(way_to_kept(c).back());
        if (out_.connections.empty() && out_.tips.empty()) move_lone_node();
        return std::move(out_);
    }

  private:
    // From a cluster to the kept ones.
    struct Way {
        std::uint32_t next = kNone;  // cluster; itself where it is kept
        std::uint32_t connection = kNone;
        std::uint32_t root = kNone;  // where it ends
        float cost = kInfinity;
        float length = 0.0f;
        float trunk = 0.0f;  // of a kept cluster: cost on to the core
        bool is_kept = false;
    };

    struct Limb {
        std::vector<std::uint32_t> way;  // clusters, from the outermost to the kept one
        std::vector<Vec3> tip;
    };

    static Coverage seed_coverage(const ClusterContext& context) {
        std::vector<Vec3> places;
        std::vector<Vec3> inside;
        for (const std::uint32_t v : context.spread.vertices) {
            places.push_back(context.surface.positions[v]);
            inside.push_back(context.inner[v]);
        }
        return {context.query, std::move(places), std::move(inside)};
    }

    // The cycles of the network, and what joins them; the thickest cluster of parts without any.
    void keep_core(const ClusterNetwork& network) {
        const Arcs spanning = arcs_of(connections_, network.spanning, girths_.size());
        std::vector<bool> is_core = thickest_of(spanning, girths_, centers_);
        for (const std::uint32_t i : network.core)
            is_core[connections_[i].a] = is_core[connections_[i].b] = true;
        std::vector<std::uint32_t> core;
        for (std::uint32_t c = 0; c < girths_.size(); ++c) {
            if (is_core[c]) core.push_back(c);
        }
        keep(core);
        for (const std::uint32_t i : network.core) keep_connection(connections_[i]);
    }

    // A plate's one node stands in its middle.
    void move_lone_node() {
        const auto is_other = [&](std::uint32_t home) { return home != out_.home.front(); };
        if (std::ranges::any_of(out_.home, is_other)) return;
        std::vector<std::uint32_t> all(girths_.size());
        std::iota(all.begin(), all.end(), 0u);
        std::ranges::fill(out_.home, thickest_in(all, kAsThickAlone, girths_, centers_));
    }

    void keep_connection(const Connection& c) {
        out_.connections.push_back(c);
        coverage_.add(c.path, girths_[c.a], girths_[c.b]);
    }

    // Ways lead to kept clusters, and are found anew where they got shorter.
    void keep(const std::vector<std::uint32_t>& kept) {
        using Entry = std::pair<float, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        kept_.insert(kept_.end(), kept.begin(), kept.end());
        for (const std::uint32_t c : kept) {
            const float trunk = ways_[c].trunk;
            ways_[c] = {c, kNone, c, kTrunkShare * trunk, 0.0f, trunk, true};
            front.emplace(ways_[c].cost, c);
            coverage_.add(std::array{centers_[c], centers_[c]}, girths_[c], girths_[c]);
        }
        while (!front.empty()) {
            const auto [cost, c] = front.top();
            front.pop();
            if (cost > ways_[c].cost) continue;
            for (const Arc& arc : arcs_[c]) {
                const Connection& connection = connections_[arc.connection];
                Way& way = ways_[arc.to];
                const float there = cost + cost_of(connection);
                if (way.is_kept || there >= way.cost) continue;
                way = {
                    c,    arc.connection, ways_[c].root, there, ways_[c].length + connection.length,
                    0.0f, false};
                front.emplace(there, arc.to);
            }
        }
    }

    // Length in girths, so that ways run along the thick middle.
    float cost_of(const Connection& c) const {
        const float girth = std::max(0.5f * (girths_[c.a] + girths_[c.b]), 1e-6f);
        return c.length / girth * (c.is_inside ? 1.0f : kUnfreeCost);
    }

    std::uint32_t farthest_out() const {
        std::uint32_t best = kNone;
        auto most = static_cast<float>(options_.detail * options_.least_world);
        for (std::uint32_t s = 0; s < is_tried_.size(); ++s) {
            const float out = is_tried_[s] ? 0.0f : sticking_out(s);
            if (out <= most) continue;
            most = out;
            best = s;
        }
        return best;
    }

    // Of places that no ball sees: what the way to them is longer than the ball that it begins in.
    float sticking_out(std::uint32_t seed) const {
        const std::uint32_t c = context_.clusters.of_point[seed];
        if (ways_[c].root == kNone) return 0.0f;
        const float along = ways_[c].length + glm::distance(coverage_.places()[seed], centers_[c]);
        return std::min(coverage_.beyond(seed), along - girths_[ways_[c].root]);
    }

    void try_limb(std::uint32_t seed) {
        is_tried_[seed] = true;
        Limb limb;
        limb.way = way_to_kept(context_.clusters.of_point[seed]);
        limb.tip = tip_of(limb.way.front(), seed);
        const float out = sticking_out(seed);
        if (!may_keep(limb) || !is_limb(limb, static_cast<double>(out))) {
            ++out_.rejected;
            return;
        }
        keep_limb(std::move(limb));
    }

    void keep_limb(Limb limb) {
        ++out_.limbs;
        limb.way = without_detours(limb.way);
        for (std::size_t i = limb.way.size() - 1; i-- > 0;) {
            const Connection c = connection_to(limb.way[i + 1], limb.way[i]);
            ways_[limb.way[i]].trunk = ways_[limb.way[i + 1]].trunk + cost_of(c);
            keep_connection(c);
        }
        const std::vector<float> tip_girths = girths_at(context_.query, limb.tip);
        for (std::size_t i = 1; i < limb.tip.size(); ++i)
            coverage_.add(std::span(limb.tip).subspan(i - 1, 2), tip_girths[i - 1], tip_girths[i]);
        if (!limb.tip.empty()) out_.tips.push_back({limb.way.front(), limb.tip});
        limb.way.pop_back();
        keep(limb.way);
    }

    // What cuts through itself may have places that no way inside leads to.
    bool may_keep(const Limb& limb) const {
        return !context_.is_closed ||
               std::all_of(limb.way.begin(), limb.way.end() - 1, [&](std::uint32_t c) {
                   return connections_[ways_[c].connection].is_inside;
               });
    }

    std::vector<std::uint32_t> way_to_kept(std::uint32_t cluster) const {
        std::vector<std::uint32_t> way{cluster};
        while (ways_[way.back()].next != way.back() && ways_[way.back()].next != kNone)
            way.push_back(ways_[way.back()].next);
        return way;
    }

    // Connections follow the surface: where a wall is thin they may lead down one side and up the
    // other, past a cluster that is near.
    std::vector<std::uint32_t> without_detours(const std::vector<std::uint32_t>& way) const {
        std::vector<std::uint32_t> out{way.front()};
        for (std::size_t i = 0; i + 1 < way.size();) {
            std::size_t next = i + 1;
            float length = 0.0f;
            for (std::size_t k = i + 1; k < way.size(); ++k) {
                length += connections_[ways_[way[k - 1]].connection].length;
                if (k > next && is_detour(way[i], way[k], length)) next = k;
            }
            out.push_back(way[next]);
            i = next;
        }
        return out;
    }

    // The one by which a cluster's way goes on; straight across where it does not go on there.
    Connection connection_to(std::uint32_t next, std::uint32_t cluster) const {
        const Way& way = ways_[cluster];
        if (way.next == next) return connections_[way.connection];
        Connection across;
        across.a = std::min(next, cluster);
        across.b = std::max(next, cluster);
        across.path = {centers_[across.a], centers_[across.b]};
        across.length = length_of(across.path);
        return across;
    }

    bool is_detour(std::uint32_t from, std::uint32_t to, float length) const {
        const float across = glm::distance(centers_[from], centers_[to]);
        return across < std::max(girths_[from], girths_[to]) && length > kDetour * across &&
               is_free(std::array{centers_[from], centers_[to]}, context_.query);
    }

    // From a cluster outwards along the way that a seed came, to the centre of the last ball that
    // touches the seed's place; empty where the cluster is near that place already, or the way is
    // not free.
    std::vector<Vec3> tip_of(std::uint32_t cluster, std::uint32_t seed) const {
        const Vec3& goal = coverage_.places()[seed];
        if (glm::distance(centers_[cluster], goal) < kNearTipGirths * girths_[cluster]) return {};
        const std::vector<Vec3>& came = context_.settled[seed].path;
        std::vector<Vec3> path{centers_[cluster]};
        path.insert(path.end(), came.rbegin(), came.rend());
        path = pull_tight(path, context_.query);
        if (!is_free(path, context_.query)) return {};
        std::vector<Vec3> tip{path.front()};
        for (std::size_t i = 1; i < path.size(); ++i) {
            for (int k = 1; k <= kTipPieces; ++k)
                tip.push_back(glm::mix(path[i - 1], path[i],
                                       static_cast<float>(k) / static_cast<float>(kTipPieces)));
        }
        while (tip.size() > 1 && context_.query.nearest(tip.back()).distance >
                                     kLastBallShare * glm::distance(tip.back(), goal))
            tip.pop_back();
        return tip.size() > 1 ? tip : std::vector<Vec3>{};
    }

    // What of a limb lies outside the balls along what is kept.
    struct Outside {
        std::vector<Vec3> places;   // evenly along it
        std::vector<Vec3> inwards;  // along it at each place, unit
        float length = 0.0f;
        float body_girth = 0.0f;  // of the ball that it leaves last
    };

    // From its outer end to the centre of the kept cluster.
    std::vector<Vec3> line_of(const Limb& limb) const {
        std::vector<Vec3> line(limb.tip.rbegin(), limb.tip.rend());
        line.push_back(centers_[limb.way.front()]);
        for (std::size_t i = 0; i + 1 < limb.way.size(); ++i) {
            const Connection& c = connections_[ways_[limb.way[i]].connection];
            if (c.a == limb.way[i])
                line.insert(line.end(), c.path.begin(), c.path.end());
            else
                line.insert(line.end(), c.path.rbegin(), c.path.rend());
        }
        return line;
    }

    // The largest ball of a kept cluster about a place that its centre sees; 0 where there is none.
    float kept_girth_about(const Vec3& place) const {
        float largest = 0.0f;
        for (const std::uint32_t c : kept_) {
            if (girths_[c] > largest && glm::distance(place, centers_[c]) <= girths_[c] &&
                is_free(std::array{place, centers_[c]}, context_.query))
                largest = girths_[c];
        }
        return largest;
    }

    Outside outside_of(const Limb& limb) const {
        const std::vector<Vec3> line = line_of(limb);
        const float step = length_of(line) / static_cast<float>(kLimbPieces);
        Outside all;
        all.body_girth = girths_[limb.way.back()];
        if (line.size() < 2) return all;
        float before = 0.0f;  // the length up to the segment's start
        std::size_t segment = 1;
        for (int k = 0; k < kLimbPieces; ++k) {
            const float at = step * (static_cast<float>(k) + 0.5f);
            float length = glm::distance(line[segment - 1], line[segment]);
            while (segment + 1 < line.size() && before + length < at) {
                before += length;
                ++segment;
                length = glm::distance(line[segment - 1], line[segment]);
            }
            if (!(length > 0.0f)) continue;
            const Vec3 inwards = (line[segment] - line[segment - 1]) / length;
            const Vec3 place = line[segment - 1] + inwards * std::min(at - before, length);
            const float girth = kept_girth_about(place);
            if (girth > 0.0f) {
                all.body_girth = girth;
                break;
            }
            all.places.push_back(place);
            all.inwards.push_back(inwards);
        }
        Outside few{{}, {}, step * static_cast<float>(all.places.size()), all.body_girth};
        const std::size_t count = std::min(kOutsidePlaces, all.places.size());
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = (2 * k + 1) * all.places.size() / (2 * count);
            few.places.push_back(all.places[i]);
            few.inwards.push_back(all.inwards[i]);
        }
        return few;
    }

    // The limb's own girth is the mean of what lies outside; the body's is that of the ball that it
    // leaves last, which need not be that of the cluster where it joins.
    bool is_limb(const Limb& limb, double out) const {
        const Outside outside = outside_of(limb);
        if (outside.places.empty()) return false;
        const std::vector<float> girths = girths_at(context_.query, outside.places);
        std::vector<float> widths;
        std::vector<float> sizes;  // radii of circles as large as the sections
        for (std::size_t i = 0; i < outside.places.size(); ++i) {
            widths.push_back(
                section_half_width(context_.query, outside.places[i], outside.inwards[i]));
            sizes.push_back(std::sqrt(girths[i] * std::max(girths[i], widths[i])));
        }
        const double girth = mean(girths);
        if (!(girth > 0.0) || is_strip_of_sheet(outside.length, median(girths), median(widths)))
            return false;
        const double own = out / girth / options_.detail;
        const double of_body = out / static_cast<double>(outside.body_girth) / options_.detail;
        const double of_size = out / mean(sizes) / options_.detail;
        const bool is_bare = !limb.tip.empty();
        return own >= options_.least_own_girths && of_body >= options_.least_body_girths &&
               own * of_body >= options_.least_product &&
               (!is_bare || of_size >= options_.bare_own_sizes ||
                of_size * of_body >= options_.bare_product ||
                out >= options_.detail * options_.bare_world);
    }

    // Whether it runs through a sheet that is about as wide as the limb is long: any way across
    // would do as well.
    bool is_strip_of_sheet(float length, float girth, float width) const {
        const auto half = static_cast<double>(width);
        return half > options_.flat_girths * static_cast<double>(girth) &&
               static_cast<double>(length) < options_.detail * options_.flat_widths * half;
    }

    // One limb changes what is far from the skeleton; what was looked at once is left alone.
    void grow_fat_ends() {
        const FarPatches far(context_);
        std::vector<bool> is_seen(is_tried_.size(), false);
        bool has_grown = true;
        while (has_grown) {
            has_grown = false;
            for (const FarPatch& patch : far.find(coverage_)) {
                if (has_grown || patch.area_depths < options_.detail * options_.fat_area) break;
                const auto was_seen = [&](std::uint32_t s) { return is_seen[s]; };
                if (std::any_of(patch.seeds.begin(), patch.seeds.end(), was_seen)) continue;
                for (const std::uint32_t s : patch.seeds) is_seen[s] = true;
                Limb limb = limb_to(patch);
                has_grown = may_keep(limb) && is_fat_end(limb, patch, far);
                if (has_grown) keep_limb(std::move(limb));
            }
        }
    }

    // Straight through the patch's middle, to before the surface.
    Limb limb_to(const FarPatch& patch) const {
        Limb limb;
        limb.way = way_to_kept(context_.clusters.of_point[patch.farthest]);
        const Vec3& from = centers_[limb.way.front()];
        const Vec3 way = patch.centre - from;
        if (!(glm::length(way) > 0.0f)) return limb;
        const Vec3 ahead = glm::normalize(way);
        const float free_way = context_.query.free_way(from, ahead);
        if (free_way >= SurfaceQuery::kFarthest) return limb;  // out through an opening
        const float last = kLastBallShare * free_way;
        for (int k = 0; k <= kTipPieces; ++k)
            limb.tip.push_back(
                from + ahead * (last * static_cast<float>(k) / static_cast<float>(kTipPieces)));
        return limb;
    }

    // It grows from a junction or a lone core, out of the ball there: other ends get extended. Flat
    // bodies are left alone: no curve lies near to all of their surface.
    bool is_fat_end(const Limb& limb, const FarPatch& patch, const FarPatches& far) const {
        const std::uint32_t root = limb.way.back();
        const auto is_at_root = [&](const Connection& c) { return c.a == root || c.b == root; };
        const auto degree =
            std::count_if(out_.connections.begin(), out_.connections.end(), is_at_root);
        const auto girth = static_cast<double>(girths_[root]);
        const auto radius = static_cast<double>(context_.query.nearest(centers_[root]).distance);
        std::vector<Vec3> line;
        for (const std::uint32_t c : limb.way) line.push_back(centers_[c]);
        std::reverse(line.begin(), line.end());
        line.insert(line.end(), limb.tip.begin(), limb.tip.end());
        const bool is_flat = girth > options_.fat_roundness * radius;
        const bool is_shallow = static_cast<double>(patch.depth) < options_.fat_depth * girth;
        const bool is_short = static_cast<double>(length_of(line)) < girth;
        if (degree == 1 || degree == 2 || is_flat || is_shallow || is_short) return false;
        double all = 0.0;
        double gained = 0.0;
        for (const std::uint32_t s : patch.seeds) {
            const auto area = static_cast<double>(far.area(s));
            all += area;
            if (!far.is_far(s, distance_to(line, coverage_.places()[s]))) gained += area;
        }
        return gained >= options_.fat_gain * all;
    }

    const ClusterContext& context_;
    std::span<const Connection> connections_;
    std::span<const Vec3> centers_;
    std::span<const float> girths_;
    const LimbOptions& options_;
    Arcs arcs_;
    std::vector<Way> ways_;
    std::vector<std::uint32_t> kept_;
    Coverage coverage_;  // of the seeds' places
    std::vector<bool> is_tried_;
    Limbs out_;
};

}  // namespace

Limbs grow_limbs(const ClusterContext& context, const ClusterNetwork& network,
                 const LimbOptions& options) {
    return LimbGrower(context, network, options).run(network);
}

}  // namespace zskel
