#include "zskel/mesh/homology.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/edges.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

using Row = std::vector<std::int64_t>;

// The triangles on both sides of every edge: `left` runs along it from the low to the high vertex.
struct EdgeSides {
    std::vector<std::uint32_t> left;
    std::vector<std::uint32_t> right;
    std::vector<std::array<std::uint32_t, 3>> triangle_edges;
};

bool find_sides(const Surface& surface, EdgeSides& sides) {
    sides.left.assign(surface.edges.size(), kNone);
    sides.right.assign(surface.edges.size(), kNone);
    sides.triangle_edges.resize(surface.triangles.size());
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = surface.triangles[t][k];
            const std::uint32_t b = surface.triangles[t][(k + 1) % 3];
            const glm::uvec2 wanted(std::min(a, b), std::max(a, b));
            const auto at =
                std::lower_bound(surface.edges.begin(), surface.edges.end(), wanted, edge_before);
            const auto e = static_cast<std::uint32_t>(at - surface.edges.begin());
            std::uint32_t& side = a < b ? sides.left[e] : sides.right[e];
            if (side != kNone) return false;
            side = t;
            sides.triangle_edges[t][static_cast<std::size_t>(k)] = e;
        }
    }
    const auto missing = [](const std::vector<std::uint32_t>& list) {
        return std::find(list.begin(), list.end(), kNone) != list.end();
    };
    return !missing(sides.left) && !missing(sides.right);
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
    std::vector<std::uint32_t> order;
    for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
        if (!tree.is_tree_edge[e]) order.push_back(e);
    }
    const auto loop_length = [&](std::uint32_t e) {
        const glm::uvec2& edge = surface.edges[e];
        return tree.distance[edge.x] + tree.distance[edge.y] +
               glm::distance(surface.positions[edge.x], surface.positions[edge.y]);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto l, auto r) { return loop_length(l) > loop_length(r); });
    DisjointSets sets(surface.triangles.size());
    is_dual_edge.assign(surface.edges.size(), false);
    std::vector<std::uint32_t> left;
    for (const std::uint32_t e : order) {
        if (sets.unite(sides.left[e], sides.right[e])) {
            is_dual_edge[e] = true;
        } else {
            left.push_back(e);
        }
    }
    return left;
}

// The closed walk root .. x, y .. root; the shared way to the root is left out.
std::vector<std::uint32_t> loop_of(const glm::uvec2& edge, const PathTree& tree) {
    const auto way = [&](std::uint32_t v) {
        std::vector<std::uint32_t> path{v};
        while (tree.parent[v] != v) path.push_back(v = tree.parent[v]);
        return path;
    };
    std::vector<std::uint32_t> a = way(edge.x);
    std::vector<std::uint32_t> b = way(edge.y);
    while (a.size() > 1 && b.size() > 1 && a[a.size() - 2] == b[b.size() - 2]) {
        a.pop_back();
        b.pop_back();
    }
    std::reverse(a.begin(), a.end());  // meeting point .. x
    b.pop_back();                      // y .. before the meeting point
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// Solid angle of the triangle (a, b, c) seen from the origin, over 2.
double half_angle(const DVec3& a, const DVec3& b, const DVec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    return std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                         glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

// Gauss's integral of two closed polygons: for each pair of segments the signed solid angle of the
// parallelogram of their differences.
double linking_number(const std::vector<DVec3>& p, const std::vector<DVec3>& q) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const DVec3& p0 = p[i];
        const DVec3& p1 = p[(i + 1) % p.size()];
        for (std::size_t j = 0; j < q.size(); ++j) {
            const DVec3& q0 = q[j];
            const DVec3& q1 = q[(j + 1) % q.size()];
            const DVec3 a = q0 - p0;
            const DVec3 b = q0 - p1;
            const DVec3 c = q1 - p1;
            const DVec3 d = q1 - p0;
            sum += half_angle(a, b, c) + half_angle(a, c, d);
        }
    }
    return sum / (2.0 * std::numbers::pi);
}

std::vector<DVec3> points_of(const std::vector<std::uint32_t>& loop,
                             const std::vector<Vec3>& positions) {
    std::vector<DVec3> points;
    for (const std::uint32_t v : loop) points.emplace_back(positions[v]);
    return points;
}

// Row echelon basis of the lattice that the rows span.
std::vector<Row> lattice_basis(std::vector<Row> rows) {
    std::size_t done = 0;
    const std::size_t width = rows.empty() ? 0 : rows[0].size();
    for (std::size_t column = 0; column < width && done < rows.size(); ++column) {
        while (true) {
            std::size_t pivot = rows.size();
            std::size_t others = 0;
            for (std::size_t r = done; r < rows.size(); ++r) {
                if (rows[r][column] == 0) continue;
                ++others;
                if (pivot == rows.size() ||
                    std::abs(rows[r][column]) < std::abs(rows[pivot][column]))
                    pivot = r;
            }
            if (others == 0) break;
            std::swap(rows[done], rows[pivot]);
            for (std::size_t r = done + 1; r < rows.size(); ++r) {
                const std::int64_t times = rows[r][column] / rows[done][column];
                for (std::size_t c = column; c < width; ++c) rows[r][c] -= times * rows[done][c];
            }
            if (others == 1) {
                ++done;
                break;
            }
        }
    }
    rows.resize(done);
    return rows;
}

// The row as a combination of a basis in row echelon form.
Row coordinates(Row row, const std::vector<Row>& basis) {
    Row out;
    for (const Row& b : basis) {
        const auto pivot = static_cast<std::size_t>(
            std::find_if(b.begin(), b.end(), [](std::int64_t value) { return value != 0; }) -
            b.begin());
        const std::int64_t times = row[pivot] / b[pivot];
        for (std::size_t c = 0; c < row.size(); ++c) row[c] -= times * b[c];
        out.push_back(times);
    }
    return out;
}

// Linking numbers of every loop pushed inside with every loop; false when one is not near an
// integer.
bool link_loops(const std::vector<std::vector<std::uint32_t>>& loops, const Surface& surface,
                const std::vector<Vec3>& inner, std::vector<Row>& matrix) {
    const std::size_t n = loops.size();
    std::vector<double> raw(n * n);
    parallel_for(n * n, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            raw[k] = linking_number(points_of(loops[k / n], inner),
                                    points_of(loops[k % n], surface.positions));
        }
    });
    matrix.assign(n, Row(n, 0));
    for (std::size_t k = 0; k < n * n; ++k) {
        matrix[k / n][k % n] = std::llround(raw[k]);
        if (std::abs(raw[k] - std::round(raw[k])) > 0.1) return false;
    }
    return true;
}

// Fills the classes of the edges that the dual tree crosses: round every triangle they sum to zero,
// so a triangle with one unknown edge settles it, from the leaves inward.
void settle_dual_edges(const Surface& surface, const EdgeSides& sides,
                       const std::vector<bool>& is_dual_edge, HandleClasses& out) {
    const std::size_t g = out.genus;
    std::vector<int> unknown(surface.triangles.size(), 0);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        for (const std::uint32_t e : sides.triangle_edges[t]) unknown[t] += is_dual_edge[e] ? 1 : 0;
    }
    std::vector<bool> known(is_dual_edge.size());
    for (std::size_t e = 0; e < known.size(); ++e) known[e] = !is_dual_edge[e];
    std::vector<std::uint32_t> ready;
    for (std::uint32_t t = 0; t < unknown.size(); ++t) {
        if (unknown[t] == 1) ready.push_back(t);
    }
    while (!ready.empty()) {
        const std::uint32_t t = ready.back();
        ready.pop_back();
        if (unknown[t] != 1) continue;
        std::uint32_t open = kNone;
        Row sum(g, 0);
        for (const std::uint32_t e : sides.triangle_edges[t]) {
            if (!known[e]) {
                open = e;
                continue;
            }
            const std::int64_t sign = sides.left[e] == t ? 1 : -1;
            for (std::size_t k = 0; k < g; ++k) sum[k] += sign * out.edge_class[e * g + k];
        }
        const std::int64_t sign = sides.left[open] == t ? -1 : 1;
        for (std::size_t k = 0; k < g; ++k)
            out.edge_class[open * g + k] = static_cast<std::int32_t>(sign * sum[k]);
        known[open] = true;
        for (const std::uint32_t side : {sides.left[open], sides.right[open]}) {
            if (--unknown[side] == 1) ready.push_back(side);
        }
    }
}

}  // namespace

std::optional<HandleClasses> find_handles(const Surface& surface, const std::vector<Vec3>& inner,
                                          std::string& why) {
    EdgeSides sides;
    if (!find_sides(surface, sides)) {
        why = "the surface is not closed, oriented and manifold";
        return std::nullopt;
    }
    const VertexGraph graph(surface.positions.size(), surface.edges);
    const PathTree tree = grow_paths(surface, graph);
    std::vector<bool> is_dual_edge;
    const std::vector<std::uint32_t> closing = loop_edges(surface, sides, tree, is_dual_edge);
    HandleClasses out;
    out.genus = closing.size() / 2;
    if (out.genus == 0) return out;
    std::vector<std::vector<std::uint32_t>> loops;
    for (const std::uint32_t e : closing) loops.push_back(loop_of(surface.edges[e], tree));
    std::vector<Row> links;
    const bool integral = link_loops(loops, surface, inner, links);
    const std::vector<Row> basis = lattice_basis(links);
    if (!integral || basis.size() != out.genus) {
        why = fmt::format("{} loops of genus {} link with rank {}{}", loops.size(), out.genus,
                          basis.size(), integral ? "" : ", not all by integers");
        return std::nullopt;
    }
    out.edge_class.assign(surface.edges.size() * out.genus, 0);
    for (std::size_t i = 0; i < closing.size(); ++i) {
        // Its loop runs from the low to the high vertex of the closing edge.
        const Row row = coordinates(links[i], basis);
        for (std::size_t k = 0; k < out.genus; ++k) {
            out.edge_class[closing[i] * out.genus + k] = static_cast<std::int32_t>(row[k]);
        }
    }
    settle_dual_edges(surface, sides, is_dual_edge, out);
    return out;
}

bool is_primitive(std::vector<std::vector<std::int64_t>> rows) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const std::size_t width = rows[r].size();
        // Column steps of Euclid's algorithm leave one entry right of the diagonal: the gcd.
        while (true) {
            std::size_t pivot = width;
            std::size_t others = 0;
            for (std::size_t c = r; c < width; ++c) {
                if (rows[r][c] == 0) continue;
                ++others;
                if (pivot == width || std::abs(rows[r][c]) < std::abs(rows[r][pivot])) pivot = c;
            }
            if (others == 0) return false;
            for (Row& row : rows) std::swap(row[r], row[pivot]);
            if (others == 1) break;
            for (std::size_t c = r + 1; c < width; ++c) {
                const std::int64_t times = rows[r][c] / rows[r][r];
                for (Row& row : rows) row[c] -= times * row[r];
            }
        }
        if (std::abs(rows[r][r]) != 1) return false;
    }
    return true;
}

}  // namespace zskel
