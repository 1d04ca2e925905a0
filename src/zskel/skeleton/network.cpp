#include "zskel/skeleton/network.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/parallel.h"
#include "zskel/skeleton/core.h"
#include "zskel/skeleton/path.h"
#include "zskel/skeleton/shell_bridges.h"

namespace zskel {
namespace {

using Class = HandleClasses::Class;

void add_to(Class& sum, const Class& other, std::int64_t sign) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += sign * other[k];
}

class Connector {
  public:
    Connector(const ClusterContext& context, const HandleClasses& handles)
        : context_(context), handles_(handles), walks_(context, handles) {
        gather();
        parallel_for(edges_.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) lay_path(out_.connections[i]);
        });
    }

    ClusterNetwork run() {
        DisjointSets sets(context_.clusters.centers.size());
        const std::vector<std::uint32_t> others = add_tree(order(), sets, out_.spanning);
        out_.has_all_cycles = add_cycles(others);
        bridge_shells(context_, sets, out_);
        for (std::size_t i = edges_.size(); i < out_.connections.size(); ++i)
            out_.connections[i].sum = walks_.sum_of(out_.connections[i].path);
        lay_cycles();
        return std::move(out_);
    }

  private:
    struct TreeLink {
        std::uint32_t cluster;
        std::uint32_t connection;
        std::int64_t sign;
    };

    // What a cluster's way from the root of its tree is.
    struct Place {
        std::uint32_t parent = kNone;
        std::uint32_t depth = 0;
        float reach = 0.0f;
        std::uint64_t sum = 0;
        Class cls;
    };

    struct Cycle {
        std::uint32_t connection;
        float length;
        std::uint64_t sum;
    };

    // One connection for each pair of clusters and class, up to its direction where both are one.
    void gather() {
        std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>> known;
        for (std::uint32_t e = 0; e < context_.surface.edges.size(); ++e) {
            std::uint32_t v = context_.surface.edges[e].x;
            std::uint32_t w = context_.surface.edges[e].y;
            if (walks_.cluster_of(v) > walks_.cluster_of(w)) std::swap(v, w);
            const std::uint32_t a = walks_.cluster_of(v);
            const std::uint32_t b = walks_.cluster_of(w);
            const std::uint64_t sum =
                walks_.sum_to(v) + handles_.edge_sum(e, v < w) - walks_.sum_to(w);
            if (a == b && sum == 0) continue;
            const std::uint64_t key = a == b ? std::min(sum, 0 - sum) : sum;
            if (!known.emplace(a, b, key).second) continue;
            out_.connections.push_back({a, b, v, w, {}, 0.0f, true, sum});
            edges_.push_back(e);
        }
    }

    // Straight where that is free and the same way round all handles; else along the surface,
    // pulled tight.
    void lay_path(Connection& c) const {
        c.path = {context_.clusters.centers[c.a], context_.clusters.centers[c.b]};
        if (c.a == c.b || !is_way(c.path, c.sum) || !is_free(c.path, context_.query)) {
            c.path = joined(walks_.short_way_to(c.vertex_a), walks_.short_way_to(c.vertex_b));
            const bool is_short = is_way(c.path, c.sum) && tighten(c);
            if (!is_short) {
                c.path = joined(walks_.walk_to(c.vertex_a), walks_.walk_to(c.vertex_b));
                c.is_inside = tighten(c);
            }
        }
        c.length = length_of(c.path);
    }

    bool is_way(std::span<const Vec3> path, std::uint64_t sum) const {
        return handles_.genus == 0 || walks_.sum_of(path) == sum;
    }

    bool tighten(Connection& c) const {
        c.path = pull_tight(c.path, context_.query, handles_);
        return is_free(c.path, context_.query);
    }

    static std::vector<Vec3> joined(std::vector<Vec3> way, const std::vector<Vec3>& back) {
        way.insert(way.end(), back.rbegin(), back.rend());
        return way;
    }

    // The class of the walk from centre to centre.
    Class class_of(std::uint32_t i) const {
        const Connection& c = out_.connections[i];
        Class cls = walks_.class_to(c.vertex_a);
        handles_.add_edge(cls, edges_[i], c.vertex_a < c.vertex_b);
        add_to(cls, walks_.class_to(c.vertex_b), -1);
        return cls;
    }

    // Of connections that may be in the tree, best first.
    std::vector<std::uint32_t> order() const {
        std::vector<std::uint32_t> out(out_.connections.size());
        std::iota(out.begin(), out.end(), 0u);
        std::vector<bool> is_cut;
        for (const Connection& c : out_.connections) is_cut.push_back(goes_through_cut(c.path));
        std::stable_sort(out.begin(), out.end(), [&](auto l, auto r) {
            const Connection& a = out_.connections[l];
            const Connection& b = out_.connections[r];
            return std::tuple(!a.is_inside, bool(is_cut[l]), a.length) <
                   std::tuple(!b.is_inside, bool(is_cut[r]), b.length);
        });
        return out;
    }

    // Whether a path comes as near the middle of a cut handle as its loop at most is.
    bool goes_through_cut(std::span<const Vec3> path) const {
        for (const SmallHandle& handle : handles_.ignored) {
            if (!handle.is_cut) continue;
            const auto reach = static_cast<float>(0.5 * std::numbers::pi * handle.radius);
            if (distance_to(path, handle.position) < reach) return true;
        }
        return false;
    }

    std::vector<Place> walk_tree(const std::vector<std::uint32_t>& tree) const {
        std::vector<std::vector<TreeLink>> links(context_.clusters.centers.size());
        for (const std::uint32_t i : tree) {
            const Connection& c = out_.connections[i];
            links[c.a].push_back({c.b, i, 1});
            links[c.b].push_back({c.a, i, -1});
        }
        std::vector<Place> places(links.size());
        for (std::uint32_t root = 0; root < links.size(); ++root) {
            if (places[root].parent != kNone) continue;
            places[root].parent = root;
            places[root].cls = handles_.zero();
            std::vector<std::uint32_t> queue{root};
            for (std::size_t i = 0; i < queue.size(); ++i) {
                const Place& here = places[queue[i]];
                for (const TreeLink& link : links[queue[i]]) {
                    if (places[link.cluster].parent != kNone) continue;
                    const Connection& by = out_.connections[link.connection];
                    Place& next = places[link.cluster];
                    next = {queue[i], here.depth + 1, here.reach + by.length,
                            link.sign > 0 ? here.sum + by.sum : here.sum - by.sum, here.cls};
                    add_to(next.cls, class_of(link.connection), link.sign);
                    queue.push_back(link.cluster);
                }
            }
        }
        return places;
    }

    std::uint32_t meeting(std::uint32_t a, std::uint32_t b) const {
        while (a != b) {
            if (places_[a].depth < places_[b].depth) std::swap(a, b);
            a = places_[a].parent;
        }
        return a;
    }

    // Adds those that join sets; the rest is left over.
    std::vector<std::uint32_t> add_tree(const std::vector<std::uint32_t>& numbers,
                                        DisjointSets& sets,
                                        std::vector<std::uint32_t>& tree) const {
        std::vector<std::uint32_t> others;
        for (const std::uint32_t i : numbers) {
            const Connection& c = out_.connections[i];
            (sets.unite(c.a, c.b) ? tree : others).push_back(i);
        }
        return others;
    }

    // All that could be laid inside, shortest first.
    std::vector<Cycle> find_cycles(const std::vector<std::uint32_t>& others) const {
        std::vector<Cycle> cycles;
        for (const std::uint32_t i : others) {
            const Connection& c = out_.connections[i];
            if (!c.is_inside) continue;
            const std::uint64_t sum = c.sum + places_[c.a].sum - places_[c.b].sum;
            const float length = c.length + places_[c.a].reach + places_[c.b].reach -
                                 2.0f * places_[meeting(c.a, c.b)].reach;
            cycles.push_back({i, length, std::min(sum, 0 - sum)});
        }
        std::stable_sort(cycles.begin(), cycles.end(),
                         [](const Cycle& l, const Cycle& r) { return l.length < r.length; });
        return cycles;
    }

    // Of the cycle that a connection closes over the tree.
    Class cycle_class(std::uint32_t i) const {
        const Connection& c = out_.connections[i];
        Class cls = class_of(i);
        add_to(cls, places_[c.a].cls, 1);
        add_to(cls, places_[c.b].cls, -1);
        return cls;
    }

    // Of each class only the shortest need be looked at. Where the surface cuts through itself, the
    // sums may not tell classes apart: then all are.
    bool add_cycles(const std::vector<std::uint32_t>& others) {
        if (handles_.cycles() == 0) return true;
        places_ = walk_tree(out_.spanning);
        CycleBasis basis(handles_);
        const std::vector<Cycle> cycles = find_cycles(others);
        std::set<std::uint64_t> known{0};
        for (const bool trusts_sums : {true, false}) {
            for (const Cycle& cycle : cycles) {
                if (basis.is_complete()) return true;
                if (trusts_sums && !known.insert(cycle.sum).second) continue;
                if (basis.extend(cycle_class(cycle.connection)))
                    out_.spanning.push_back(cycle.connection);
            }
        }
        return basis.is_complete();
    }

    void lay_cycles() {
        if (handles_.cycles() == 0) return;
        out_.core = core_of(out_.connections, out_.spanning, context_.girths.size());
        if (!out_.has_all_cycles) return;
        LaidCore laid = lay_core(context_.query, context_.girths, out_.connections, out_.core);
        const bool is_right = has_all_cycles(laid.connections);
        out_.is_core_laid = laid.is_complete && is_right;
        if (is_right) out_.core = std::move(laid.connections);
    }

    // Asks the classes themselves, of which the sums that cycles are laid by may tell too little.
    // Bridges between shells are in no cycle.
    bool has_all_cycles(std::vector<std::uint32_t> core) {
        std::erase_if(core, [&](std::uint32_t i) { return i >= edges_.size(); });
        DisjointSets sets(context_.clusters.centers.size());
        std::vector<std::uint32_t> tree;
        const std::vector<std::uint32_t> others = add_tree(core, sets, tree);
        places_.clear();  // as large again
        places_ = walk_tree(tree);
        CycleBasis basis(handles_);
        return std::ranges::all_of(others,
                                   [&](std::uint32_t i) { return basis.extend(cycle_class(i)); }) &&
               basis.is_complete();
    }

    const ClusterContext& context_;
    const HandleClasses& handles_;
    SurfaceWalks walks_;
    ClusterNetwork out_;
    std::vector<std::uint32_t> edges_;  // of each connection but the bridges, from its vertex_a on
    std::vector<Place> places_;         // in the tree that cycles are closed over
};

}  // namespace

ClusterNetwork connect_network(const ClusterContext& context, const HandleClasses& handles) {
    return Connector(context, handles).run();
}

}  // namespace zskel
