#include "zskel/skeleton/network.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

using Class = std::vector<std::int64_t>;

struct Candidate {
    Connection connection;
    Class cls;  // along the mesh edge, from root to root of the two patches
};

void add_to(Class& sum, const Class& other, std::int64_t sign) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += sign * other[k];
}

class Network {
  public:
    Network(const ClusterContext& context, const std::optional<HandleClasses>& handles)
        : context_(context),
          handles_(handles),
          genus_(handles ? handles->genus : 0),
          graph_(context.surface.positions.size(), context.surface.edges) {
        walk_patches();
        gather();
        parallel_for(candidates_.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) lay_path(candidates_[i].connection);
        });
    }

    ClusterNetwork choose() {
        std::vector<std::uint32_t> order(candidates_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](auto l, auto r) {
            const Connection& a = candidates_[l].connection;
            const Connection& b = candidates_[r].connection;
            return std::pair(!a.is_inside, a.length) < std::pair(!b.is_inside, b.length);
        });
        ClusterNetwork out;
        std::vector<std::uint32_t> others;
        DisjointSets sets(context_.clusters.centers.size());
        tree_.assign(context_.clusters.centers.size(), {});
        for (const std::uint32_t i : order) {
            const Connection& c = candidates_[i].connection;
            if (!sets.unite(c.a, c.b)) {
                others.push_back(i);
                continue;
            }
            out.spanning.push_back(i);
            tree_[c.a].push_back({c.b, i, 1});
            tree_[c.b].push_back({c.a, i, -1});
        }
        out.has_all_cycles = genus_ == 0 || add_cycles(others, out.spanning);
        for (Candidate& candidate : candidates_)
            out.connections.push_back(std::move(candidate.connection));
        bridge_shells(sets, out);
        return out;
    }

  private:
    struct TreeLink {
        std::uint32_t cluster;
        std::uint32_t candidate;
        std::int64_t sign;
    };

    std::uint32_t cluster_of(std::uint32_t vertex) const {
        return context_.clusters.of_point[context_.spread.seed_of[vertex]];
    }

    Class class_of(std::uint32_t edge, bool forward) const {
        Class out(genus_, 0);
        for (std::size_t k = 0; k < genus_; ++k) {
            out[k] = (forward ? 1 : -1) * handles_->edge_class[edge * genus_ + k];
        }
        return out;
    }

    // The class of the way to every vertex from the first seed of its cluster: from seed to seed
    // where their patches meet or a shortcut joins them, then within the patch.
    void walk_patches() {
        if (genus_ == 0) return;
        walk_cells();
        const std::map<std::pair<std::uint32_t, std::uint32_t>, Class> seed_links =
            classify_links();
        const auto link_class = [&](std::uint32_t a, std::uint32_t b) {
            Class cls(genus_, 0);
            add_to(cls, seed_links.at(std::minmax(a, b)), a < b ? 1 : -1);
            return cls;
        };
        struct Way {
            std::uint32_t seed;
            Class cls;
        };
        const std::size_t seeds = context_.spread.vertices.size();
        std::vector<std::vector<Way>> ways(seeds);
        const auto add_way = [&](std::uint32_t a, std::uint32_t b, const Class& cls) {
            if (context_.clusters.of_point[a] != context_.clusters.of_point[b]) return;
            Class back(genus_, 0);
            add_to(back, cls, -1);
            ways[a].push_back({b, cls});
            ways[b].push_back({a, std::move(back)});
        };
        for (const glm::uvec2& link : context_.links)
            add_way(link.x, link.y, link_class(link.x, link.y));
        for (const Shortcut& shortcut : context_.shortcuts) {
            Class cls(genus_, 0);
            for (std::size_t i = 1; i < shortcut.walk.size(); ++i) {
                add_to(cls, link_class(shortcut.walk[i - 1], shortcut.walk[i]), 1);
            }
            add_way(shortcut.walk.front(), shortcut.walk.back(), cls);
        }
        std::vector<Class> to_seed(seeds);
        for (std::uint32_t root = 0; root < seeds; ++root) {
            if (!to_seed[root].empty()) continue;
            to_seed[root].assign(genus_, 0);
            std::vector<std::uint32_t> queue{root};
            for (std::size_t i = 0; i < queue.size(); ++i) {
                for (const Way& way : ways[queue[i]]) {
                    if (!to_seed[way.seed].empty()) continue;
                    to_seed[way.seed] = to_seed[queue[i]];
                    add_to(to_seed[way.seed], way.cls, 1);
                    queue.push_back(way.seed);
                }
            }
        }
        for (std::uint32_t v = 0; v < graph_.size(); ++v)
            add_to(from_root_[v], to_seed[context_.spread.seed_of[v]], 1);
    }

    // The class of the way from its seed's vertex to every vertex, along the parents.
    void walk_cells() {
        from_root_.assign(graph_.size(), {});
        for (std::uint32_t v = 0; v < graph_.size(); ++v) {
            std::vector<std::uint32_t> way;
            std::uint32_t at = v;
            for (; from_root_[at].empty() && context_.spread.parent[at] != at;
                 at = context_.spread.parent[at]) {
                way.push_back(at);
            }
            if (from_root_[at].empty()) from_root_[at].assign(genus_, 0);
            for (auto next = way.rbegin(); next != way.rend(); ++next) {
                from_root_[*next] = from_root_[at];
                add_to(from_root_[*next], class_between(at, *next), 1);
                at = *next;
            }
        }
    }

    Class class_between(std::uint32_t v, std::uint32_t w) const {
        for (const VertexGraph::Link& link : graph_.of(v)) {
            if (link.vertex == w) return class_of(link.edge, v < w);
        }
        return Class(genus_, 0);
    }

    // Of every two seeds whose patches meet, lower first: the class of the way between their
    // vertices.
    std::map<std::pair<std::uint32_t, std::uint32_t>, Class> classify_links() const {
        std::map<std::pair<std::uint32_t, std::uint32_t>, Class> out;
        for (std::uint32_t e = 0; e < context_.surface.edges.size(); ++e) {
            std::uint32_t v = context_.surface.edges[e].x;
            std::uint32_t w = context_.surface.edges[e].y;
            if (context_.spread.seed_of[v] == context_.spread.seed_of[w]) continue;
            if (context_.spread.seed_of[v] > context_.spread.seed_of[w]) std::swap(v, w);
            const auto [at, is_new] = out.try_emplace(
                {context_.spread.seed_of[v], context_.spread.seed_of[w]}, from_root_[v]);
            if (!is_new) continue;
            add_to(at->second, class_between(v, w), 1);
            add_to(at->second, from_root_[w], -1);
        }
        return out;
    }

    // One candidate for each pair of clusters and class.
    void gather() {
        std::map<std::pair<std::pair<std::uint32_t, std::uint32_t>, Class>, std::size_t> known;
        for (std::uint32_t e = 0; e < context_.surface.edges.size(); ++e) {
            std::uint32_t v = context_.surface.edges[e].x;
            std::uint32_t w = context_.surface.edges[e].y;
            if (cluster_of(v) == cluster_of(w)) continue;
            Class cls = class_of(e, true);
            if (cluster_of(v) > cluster_of(w)) {
                std::swap(v, w);
                cls = class_of(e, false);
            }
            if (genus_ > 0) {
                add_to(cls, from_root_[v], 1);
                add_to(cls, from_root_[w], -1);
            }
            Candidate candidate{{cluster_of(v), cluster_of(w), v, w, {}, 0.0f, true}, cls};
            const auto [at, is_new] = known.try_emplace(
                {{candidate.connection.a, candidate.connection.b}, cls}, candidates_.size());
            if (is_new) candidates_.push_back(std::move(candidate));
        }
    }

    // Straight when that is free; else down the way of one seed, along the surface, and up the
    // other's.
    void lay_path(Connection& c) const {
        const Vec3& from = context_.clusters.centers[c.a];
        const Vec3& to = context_.clusters.centers[c.b];
        c.path = {from, to};
        if (!is_free(c.path, context_.query)) {
            std::vector<Vec3> way{from};
            append_way(c.vertex_a, way);
            std::vector<Vec3> back{to};
            append_way(c.vertex_b, back);
            way.insert(way.end(), back.rbegin(), back.rend());
            c.path = pull_tight(way, context_.query);
            c.is_inside = is_free(c.path, context_.query);
        }
        c.length = 0.0f;
        for (std::size_t i = 1; i < c.path.size(); ++i)
            c.length += glm::distance(c.path[i - 1], c.path[i]);
    }

    // From the end of the vertex's seed, back along its path to its start, then over the surface to
    // the vertex.
    void append_way(std::uint32_t vertex, std::vector<Vec3>& way) const {
        const SettledSeed& seed = context_.settled[context_.spread.seed_of[vertex]];
        way.insert(way.end(), seed.path.rbegin(), seed.path.rend());
        std::vector<Vec3> over;
        for (std::uint32_t v = vertex;; v = context_.spread.parent[v]) {
            over.push_back(context_.inner[v]);
            if (context_.spread.parent[v] == v) break;
        }
        way.insert(way.end(), over.rbegin(), over.rend());
    }

    // The mesh joins nothing across a solid's shells (a ball with a cavity); the nearest clusters
    // that see each other do.
    void bridge_shells(DisjointSets& sets, ClusterNetwork& out) const {
        const std::vector<Vec3>& centers = context_.clusters.centers;
        std::vector<Connection> bridges;
        for (std::uint32_t a = 0; a < centers.size(); ++a) {
            if (sets.find(a) == sets.find(0)) continue;
            for (std::uint32_t b = 0; b < centers.size(); ++b) {
                if (sets.find(b) == sets.find(a) || (b < a && sets.find(b) != sets.find(0)))
                    continue;
                bridges.push_back({std::min(a, b),
                                   std::max(a, b),
                                   0,
                                   0,
                                   {centers[std::min(a, b)], centers[std::max(a, b)]},
                                   glm::distance(centers[a], centers[b]),
                                   true});
            }
        }
        std::stable_sort(
            bridges.begin(), bridges.end(),
            [](const Connection& l, const Connection& r) { return l.length < r.length; });
        for (const Connection& bridge : bridges) {
            if (sets.find(bridge.a) == sets.find(bridge.b) || !is_free(bridge.path, context_.query))
                continue;
            sets.unite(bridge.a, bridge.b);
            out.spanning.push_back(static_cast<std::uint32_t>(out.connections.size()));
            out.connections.push_back(bridge);
        }
    }

    struct Cycle {
        std::uint32_t candidate;
        float length;
        Class cls;
    };

    // Distance and class from the root of its tree to every cluster.
    void walk_tree() {
        const std::size_t count = tree_.size();
        parent_.assign(count, kNone);
        depth_.assign(count, 0);
        reach_.assign(count, 0.0f);
        potential_.assign(count, Class(genus_, 0));
        for (std::uint32_t root = 0; root < count; ++root) {
            if (parent_[root] != kNone) continue;
            parent_[root] = root;
            std::vector<std::uint32_t> queue{root};
            for (std::size_t i = 0; i < queue.size(); ++i) {
                const std::uint32_t c = queue[i];
                for (const TreeLink& link : tree_[c]) {
                    if (parent_[link.cluster] != kNone) continue;
                    parent_[link.cluster] = c;
                    depth_[link.cluster] = depth_[c] + 1;
                    reach_[link.cluster] =
                        reach_[c] + candidates_[link.candidate].connection.length;
                    potential_[link.cluster] = potential_[c];
                    add_to(potential_[link.cluster], candidates_[link.candidate].cls, link.sign);
                    queue.push_back(link.cluster);
                }
            }
        }
    }

    std::uint32_t meeting(std::uint32_t a, std::uint32_t b) const {
        while (a != b) {
            if (depth_[a] < depth_[b]) std::swap(a, b);
            a = parent_[a];
        }
        return a;
    }

    bool add_cycles(const std::vector<std::uint32_t>& others,
                    std::vector<std::uint32_t>& spanning) {
        walk_tree();
        std::vector<Cycle> cycles;
        for (const std::uint32_t i : others) {
            const Connection& c = candidates_[i].connection;
            if (!c.is_inside) continue;
            Class cls = candidates_[i].cls;
            add_to(cls, potential_[c.a], 1);
            add_to(cls, potential_[c.b], -1);
            if (std::all_of(cls.begin(), cls.end(), [](std::int64_t k) { return k == 0; }))
                continue;
            const float length =
                c.length + reach_[c.a] + reach_[c.b] - 2.0f * reach_[meeting(c.a, c.b)];
            cycles.push_back({i, length, std::move(cls)});
        }
        std::stable_sort(cycles.begin(), cycles.end(),
                         [](const Cycle& l, const Cycle& r) { return l.length < r.length; });
        std::vector<Class> accepted;
        for (const Cycle& cycle : cycles) {
            if (accepted.size() == genus_) break;
            accepted.push_back(cycle.cls);
            if (is_primitive(accepted)) {
                spanning.push_back(cycle.candidate);
            } else {
                accepted.pop_back();
            }
        }
        return accepted.size() == genus_;
    }

    const ClusterContext& context_;
    const std::optional<HandleClasses>& handles_;
    std::size_t genus_;
    VertexGraph graph_;
    std::vector<Class> from_root_;
    std::vector<Candidate> candidates_;
    std::vector<std::vector<TreeLink>> tree_;
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint32_t> depth_;
    std::vector<float> reach_;
    std::vector<Class> potential_;
};

}  // namespace

ClusterNetwork connect_network(const ClusterContext& context,
                               const std::optional<HandleClasses>& handles) {
    return Network(context, handles).choose();
}

std::vector<Vec3> pull_tight(const std::vector<Vec3>& path, const SurfaceQuery& query) {
    std::vector<Vec3> out{path.front()};
    std::size_t at = 0;
    while (at + 1 < path.size()) {
        std::size_t next = path.size() - 1;
        while (next > at + 1 && query.first_hit(path[at], path[next])) --next;
        out.push_back(path[next]);
        at = next;
    }
    return out;
}

bool is_free(std::span<const Vec3> path, const SurfaceQuery& query) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (query.first_hit(path[i - 1], path[i])) return false;
    }
    return true;
}

}  // namespace zskel
