// Erickson and Whittlesey, "Greedy optimal homotopy and homology generators", 2005. Coordinates
// come from the dual tree: round every triangle the classes of its edges sum to zero, so the class
// of an edge that the dual tree crosses is the sum of the loops' own edges round the branch of the
// tree behind it. In the tree's order these are neighbours, and two numbers hold them.
#include "zskel/mesh/loops.h"

#include <algorithm>
#include <array>
#include <bit>
#include <queue>
#include <unordered_map>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/mesh/sides.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

// The triangles on both sides of an edge: `left` runs along it from the low to the high vertex.
struct EdgeTriangles {
    std::uint32_t left = kNone;
    std::uint32_t right = kNone;
};

struct EdgeSides {
    std::vector<EdgeTriangles> of_edge;
    std::vector<std::array<std::uint32_t, 3>> triangle_edges;
};

bool find_sides(const Surface& surface, EdgeSides& sides) {
    sides.of_edge.assign(surface.edges.size(), {});
    sides.triangle_edges.resize(surface.triangles.size());
    const std::vector<Side> all = sorted_sides(surface.triangles, surface.positions.size());
    std::uint32_t e = 0;
    bool is_manifold = true;
    for_each_edge(all, [&](std::size_t first, std::size_t last) {
        is_manifold =
            is_manifold && last - first == 2 && all[first].is_forward != all[first + 1].is_forward;
        for (std::size_t i = first; i < last; ++i) {
            EdgeTriangles& both = sides.of_edge[e];
            (all[i].is_forward ? both.left : both.right) = all[i].triangle;
            sides.triangle_edges[all[i].triangle][all[i].corner] = e;
        }
        ++e;
    });
    return is_manifold;
}

// By Euler's formula: a closed surface without handles has two more vertices and faces than edges
// in each component.
bool has_handles(const Surface& surface) {
    DisjointSets sets(surface.positions.size());
    std::size_t components = surface.positions.size();
    for (const glm::uvec2& e : surface.edges) components -= sets.unite(e.x, e.y) ? 1 : 0;
    return surface.positions.size() + surface.triangles.size() !=
           surface.edges.size() + 2 * components;
}

// Shortest paths from the first vertex of every component.
struct PathTree {
    std::vector<float> distance;
    std::vector<std::uint32_t> parent;  // itself at a root
    std::vector<bool> is_tree_edge;
    std::size_t components = 0;
};

PathTree grow_paths(const Surface& surface, const VertexGraph& graph) {
    PathTree tree{std::vector<float>(graph.size(), kInfinity),
                  std::vector<std::uint32_t>(graph.size(), kNone),
                  std::vector<bool>(surface.edges.size(), false), 0};
    std::vector<std::uint32_t> parent_edge(graph.size(), kNone);
    using Entry = std::pair<float, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (std::uint32_t root = 0; root < graph.size(); ++root) {
        if (tree.parent[root] != kNone) continue;
        ++tree.components;
        tree.distance[root] = 0.0f;
        tree.parent[root] = root;
        front.emplace(0.0f, root);
        while (!front.empty()) {
            const auto [distance, v] = front.top();
            front.pop();
            if (distance > tree.distance[v]) continue;
            for (const VertexGraph::Link& link : graph.of(v)) {
                const float along =
                    distance + glm::distance(surface.positions[v], surface.positions[link.vertex]);
                if (along >= tree.distance[link.vertex]) continue;
                tree.distance[link.vertex] = along;
                tree.parent[link.vertex] = v;
                parent_edge[link.vertex] = link.edge;
                front.emplace(along, link.vertex);
            }
        }
    }
    for (const std::uint32_t e : parent_edge) {
        if (e != kNone) tree.is_tree_edge[e] = true;
    }
    return tree;
}

// A spanning tree of the triangles over edges that the path tree does not use, those first that
// would close the longest loops; the edges that are left close the 2g shortest.
std::vector<std::uint32_t> loop_edges(const Surface& surface, const EdgeSides& sides,
                                      const PathTree& tree, std::vector<bool>& is_dual_edge) {
    // Lengths are not negative, so that their bits are in their order; equal ones by their numbers.
    std::vector<std::uint64_t> order;
    for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
        if (tree.is_tree_edge[e]) continue;
        const glm::uvec2& edge = surface.edges[e];
        const float length = tree.distance[edge.x] + tree.distance[edge.y] +
                             glm::distance(surface.positions[edge.x], surface.positions[edge.y]);
        order.push_back(std::uint64_t{~std::bit_cast<std::uint32_t>(length)} << 32 | e);
    }
    std::sort(order.begin(), order.end());
    DisjointSets sets(surface.triangles.size());
    is_dual_edge.assign(surface.edges.size(), false);
    std::vector<std::uint32_t> left;
    for (const std::uint64_t entry : order) {
        const auto e = static_cast<std::uint32_t>(entry);
        if (sets.unite(sides.of_edge[e].left, sides.of_edge[e].right)) {
            is_dual_edge[e] = true;
        } else {
            left.push_back(e);
        }
    }
    return left;
}

std::vector<std::uint32_t> way_to_root(std::uint32_t v, const PathTree& tree) {
    std::vector<std::uint32_t> path{v};
    while (tree.parent[path.back()] != path.back()) path.push_back(tree.parent[path.back()]);
    return path;
}

// Walks the dual tree depth first, numbers the sides of the loops' own edges as they are met, and
// gives every edge the sides behind it.
class SpanFinder {
  public:
    SpanFinder(const EdgeSides& sides, const std::vector<bool>& is_dual_edge,
               const std::vector<std::uint32_t>& closing, LoopSystem& out)
        : sides_(sides),
          is_dual_edge_(is_dual_edge),
          is_closing_(is_dual_edge.size(), false),
          is_met_(sides.triangle_edges.size(), false),
          out_(out) {
        for (std::uint32_t i = 0; i < closing.size(); ++i) {
            is_closing_[closing[i]] = true;
            loop_of_edge_.emplace(closing[i], i);
        }
        out_.edge_span.assign(is_dual_edge.size(), glm::uvec2(0));
    }

    void run() {
        for (std::uint32_t t = 0; t < is_met_.size(); ++t) {
            if (!is_met_[t]) walk(t);
        }
    }

  private:
    struct Step {
        std::uint32_t triangle;
        std::uint32_t from_edge;
        std::uint32_t first_side;
        std::size_t next = 0;  // corner
    };

    std::uint32_t side_count() const { return static_cast<std::uint32_t>(out_.sides.size()); }

    void walk(std::uint32_t root) {
        std::vector<Step> stack{{root, kNone, side_count()}};
        is_met_[root] = true;
        while (!stack.empty()) {
            Step& step = stack.back();
            if (step.next == 3) {
                if (step.from_edge != kNone) close(step);
                stack.pop_back();
                continue;
            }
            const std::uint32_t t = step.triangle;
            const std::uint32_t e = sides_.triangle_edges[t][step.next++];
            if (is_closing_[e]) add_side(e, sides_.of_edge[e].left == t);
            if (!is_dual_edge_[e] || e == step.from_edge) continue;
            const EdgeTriangles& both = sides_.of_edge[e];
            const std::uint32_t other = both.left == t ? both.right : both.left;
            is_met_[other] = true;
            stack.push_back({other, e, side_count()});
        }
    }

    void add_side(std::uint32_t edge, bool is_left) {
        if (is_left) out_.edge_span[edge] = {side_count(), side_count() + 1};
        out_.sides.push_back({loop_of_edge_.at(edge), is_left ? 1 : -1});
    }

    void close(const Step& step) {
        const bool is_left = sides_.of_edge[step.from_edge].left == step.triangle;
        out_.edge_span[step.from_edge] = is_left ? glm::uvec2(side_count(), step.first_side)
                                                 : glm::uvec2(step.first_side, side_count());
    }

    const EdgeSides& sides_;
    const std::vector<bool>& is_dual_edge_;
    std::vector<bool> is_closing_;
    std::unordered_map<std::uint32_t, std::uint32_t> loop_of_edge_;
    std::vector<bool> is_met_;
    LoopSystem& out_;
};

}  // namespace

std::optional<LoopSystem> find_loops(const Surface& surface) {
    EdgeSides sides;
    if (!find_sides(surface, sides)) return std::nullopt;
    LoopSystem out;
    if (!has_handles(surface)) {
        out.edge_span.assign(surface.edges.size(), glm::uvec2(0));
        return out;
    }
    const VertexGraph graph(surface.positions.size(), surface.edges);
    const PathTree tree = grow_paths(surface, graph);
    std::vector<bool> is_dual_edge;
    const std::vector<std::uint32_t> closing = loop_edges(surface, sides, tree, is_dual_edge);
    for (const std::uint32_t e : closing) {
        out.loops.push_back(joined_ways(way_to_root(surface.edges[e].x, tree),
                                        way_to_root(surface.edges[e].y, tree)));
    }
    SpanFinder(sides, is_dual_edge, closing, out).run();
    return out;
}

std::vector<std::uint32_t> joined_ways(std::vector<std::uint32_t> a, std::vector<std::uint32_t> b) {
    while (a.size() > 1 && b.size() > 1 && a[a.size() - 2] == b[b.size() - 2]) {
        a.pop_back();
        b.pop_back();
    }
    std::reverse(a.begin(), a.end());
    b.pop_back();
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

}  // namespace zskel
