// A shortest loop through a vertex is two shortest paths and an edge between them, as in Erickson
// and Whittlesey (2005). Which loops bound inside, or outside, is told by sums of random numbers
// along them, one linear in the classes inside and one in those outside, before the few shortest
// are looked at exactly.
#include "zskel/mesh/small_handles.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/mesh/local_paths.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

using Vector = IntegerBasis::Vector;

constexpr double kRootSpacing = 0.125;  // of the places looked at, in radii

// Of every edge, low to high vertex.
std::vector<WalkSums> edge_sums(const LoopSystem& system, const std::vector<Vector>& links) {
    std::vector<WalkSums> of_loop(system.loops.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
        for (std::size_t j = 0; j < links.size(); ++j) {
            const auto value = static_cast<std::uint64_t>(links[i][j]);
            of_loop[i].inside += value * random_number(j);
            of_loop[j].outside += value * random_number(i);
        }
    }
    std::vector<WalkSums> before{{}};
    for (const LoopSystem::Side& side : system.sides) {
        const WalkSums& own = of_loop[side.loop];
        before.push_back(side.sign > 0 ? before.back() + own : before.back() - own);
    }
    std::vector<WalkSums> out;
    for (const glm::uvec2& span : system.edge_span) out.push_back(before[span.y] - before[span.x]);
    return out;
}

struct Found {
    float length;
    std::uint32_t root;
    std::uint32_t edge;
    bool is_cut;
    std::uint64_t key;  // of the class up to its sign
};

auto by_length(const Found& found) {
    return std::tie(found.length, found.root, found.edge);
}

// Loops that are nothing inside or nothing outside but not both: the shortest of each class.
void keep_shortest(const Found& found, std::vector<Found>& list) {
    const auto same = std::find_if(list.begin(), list.end(), [&](const Found& known) {
        return known.key == found.key && known.is_cut == found.is_cut;
    });
    if (same == list.end()) {
        list.push_back(found);
    } else if (by_length(found) < by_length(*same)) {
        *same = found;
    }
}

class Search {
  public:
    Search(const Surface& surface, const LoopSystem& system, const std::vector<Vector>& links,
           double max_radius)
        : surface_(surface),
          system_(system),
          links_(links),
          graph_(surface.positions.size(), surface.edges),
          sums_(edge_sums(system, links)),
          max_length_(static_cast<float>(2.0 * std::numbers::pi * max_radius)),
          root_spacing_(static_cast<float>(kRootSpacing * max_radius)) {}

    SmallHandles run() {
        const std::vector<Found> found = find_loops_of_roots();
        const std::size_t genus = links_.size() / 2;
        IntegerBasis cut(links_.size());
        IntegerBasis filled(links_.size());
        LocalPaths paths(surface_, graph_, sums_);
        SmallHandles out;
        for (const Found& f : found) {
            if (out.handles.size() == genus) break;
            paths.run(f.root, 0.5f * max_length_);
            const glm::uvec2& edge = surface_.edges[f.edge];
            const std::vector<std::uint32_t> loop =
                joined_ways(paths.path_from(edge.x), paths.path_from(edge.y));
            const Vector own = coordinates(loop);
            if (!is_apart(own, out)) continue;
            if (!(f.is_cut ? cut.extend(linked_by(own)) : filled.extend(links_with(own)))) continue;
            out.handles.push_back(
                {0.5 * static_cast<double>(f.length) / std::numbers::pi, mean_of(loop), f.is_cut});
            out.loops.push_back(own);
        }
        return out;
    }

  private:
    // Every loop that is not nothing passes a vertex of the system's loops.
    std::vector<std::uint32_t> roots() const {
        LocalPaths paths(surface_, graph_, sums_);
        std::vector<bool> is_covered(graph_.size(), false);
        std::vector<std::uint32_t> out;
        for (const std::vector<std::uint32_t>& loop : system_.loops) {
            for (const std::uint32_t v : loop) {
                if (is_covered[v]) continue;
                out.push_back(v);
                paths.run(v, root_spacing_);
                for (const std::uint32_t near : paths.reached()) is_covered[near] = true;
            }
        }
        return out;
    }

    std::vector<Found> find_loops_of_roots() const {
        const std::vector<std::uint32_t> from = roots();
        std::vector<std::vector<Found>> of_root(from.size());
        parallel_for(from.size(), 64, [&](std::size_t begin, std::size_t end) {
            LocalPaths paths(surface_, graph_, sums_);
            for (std::size_t i = begin; i < end; ++i) {
                paths.run(from[i], 0.5f * max_length_);
                paths.each_loop([&](std::uint32_t edge, float length, const WalkSums& sums) {
                    if (length > max_length_ || (sums.inside == 0) == (sums.outside == 0)) return;
                    const std::uint64_t key = sums.inside + sums.outside;
                    keep_shortest({length, from[i], edge, sums.inside == 0, std::min(key, 0 - key)},
                                  of_root[i]);
                });
            }
        });
        std::map<std::pair<std::uint64_t, bool>, Found> shortest;
        for (const std::vector<Found>& list : of_root) {
            for (const Found& found : list) {
                const auto [at, is_new] =
                    shortest.try_emplace(std::pair(found.key, found.is_cut), found);
                if (!is_new && by_length(found) < by_length(at->second)) at->second = found;
            }
        }
        std::vector<Found> out;
        for (const auto& [key, found] : shortest) out.push_back(found);
        std::sort(out.begin(), out.end(),
                  [](const Found& l, const Found& r) { return by_length(l) < by_length(r); });
        return out;
    }

    Vec3 mean_of(const std::vector<std::uint32_t>& loop) const {
        DVec3 sum(0.0);
        for (const std::uint32_t v : loop) sum += DVec3(surface_.positions[v]);
        return Vec3(sum / static_cast<double>(loop.size()));
    }

    // How often a closed walk runs along each loop of the system.
    Vector coordinates(const std::vector<std::uint32_t>& walk) const {
        Vector steps(system_.sides.size() + 1, 0);
        for (std::size_t i = 0; i < walk.size(); ++i) {
            const std::uint32_t next = walk[(i + 1) % walk.size()];
            for (const VertexGraph::Link& link : graph_.of(walk[i])) {
                if (link.vertex != next) continue;
                const glm::uvec2& span = system_.edge_span[link.edge];
                steps[walk[i] < next ? span.x : span.y] += 1;
                steps[walk[i] < next ? span.y : span.x] -= 1;
            }
        }
        Vector out(system_.loops.size(), 0);
        std::int64_t times = 0;
        for (std::size_t k = 0; k < system_.sides.size(); ++k) {
            times += steps[k];
            out[system_.sides[k].loop] += system_.sides[k].sign * times;
        }
        return out;
    }

    // Linking numbers of a walk pushed inside with the system's loops.
    Vector links_with(const Vector& walk) const {
        Vector out(links_.size(), 0);
        for (std::size_t i = 0; i < walk.size(); ++i) {
            if (walk[i] == 0) continue;
            for (std::size_t j = 0; j < out.size(); ++j) out[j] += walk[i] * links_[i][j];
        }
        return out;
    }

    // Of the system's loops pushed inside with a walk.
    Vector linked_by(const Vector& walk) const {
        Vector out(links_.size(), 0);
        for (std::size_t j = 0; j < walk.size(); ++j) {
            if (walk[j] == 0) continue;
            for (std::size_t i = 0; i < out.size(); ++i) out[i] += walk[j] * links_[i][j];
        }
        return out;
    }

    // Whether a loop crosses none of those taken, signs taken.
    bool is_apart(const Vector& walk, const SmallHandles& taken) const {
        const Vector over = links_with(walk);
        const Vector under = linked_by(walk);
        return std::all_of(taken.loops.begin(), taken.loops.end(), [&](const Vector& other) {
            std::int64_t crossings = 0;
            for (std::size_t k = 0; k < other.size(); ++k)
                crossings += other[k] * (over[k] - under[k]);
            return crossings == 0;
        });
    }

    const Surface& surface_;
    const LoopSystem& system_;
    const std::vector<Vector>& links_;
    VertexGraph graph_;
    std::vector<WalkSums> sums_;
    float max_length_;
    float root_spacing_;
};

}  // namespace

SmallHandles find_small_handles(const Surface& surface, const LoopSystem& system,
                                const std::vector<IntegerBasis::Vector>& links, double max_radius) {
    return Search(surface, system, links, max_radius).run();
}

}  // namespace zskel
