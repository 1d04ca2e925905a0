// Edges come from a sorted table of triangle sides, which holds any number of triangles an edge.
// What is manifold of it goes into OpenMesh's half-edge mesh, which gives boundary loops and Euler
// numbers.
#include "zskel/mesh/topology.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <numeric>

#include "zskel/core/assert.h"
#include "zskel/core/disjoint_sets.h"
#include "zskel/core/edges.h"
#include "zskel/mesh/sides.h"

namespace zskel {
namespace {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// Two triangles at an edge that no third one shares.
struct Link {
    Side left;
    Side right;
    bool agrees() const { return left.is_forward != right.is_forward; }
};

bool has_three_corners(const Triangle& t) {
    return t.x != t.y && t.y != t.z && t.z != t.x;
}

/// Hides OpenMesh's own messages as long as it lives.
class QuietOpenMesh {
  public:
    QuietOpenMesh() : was_enabled_(omerr().is_enabled()) { omerr().disable(); }
    ~QuietOpenMesh() {
        if (was_enabled_) omerr().enable();
    }
    QuietOpenMesh(const QuietOpenMesh&) = delete;
    QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

  private:
    bool was_enabled_;
};

class TopologyFinder {
  public:
    TopologyFinder(std::size_t vertex_count, std::span<const Triangle> triangles)
        : vertex_count_(vertex_count),
          triangles_(triangles),
          parts_(triangles.size()),
          fans_(triangles.size() * 3) {}

    Topology find() {
        const std::vector<Side> sides = sorted_sides(triangles_, vertex_count_);
        collect_edges(sides);
        number_components();
        mark_edges(sides);
        orient();
        number_copies();
        find_non_manifold_vertices();
        build_half_edges();
        measure_components();
        collect_boundary_loops();
        find_genus();
        return std::move(out_);
    }

  private:
    template <typename Visit>
    static void for_each_edge(const std::vector<Side>& sides, Visit visit) {
        for (std::size_t first = 0; first < sides.size();) {
            std::size_t last = first + 1;
            while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
            visit(std::span(sides).subspan(first, last - first));
            first = last;
        }
    }

    TopologyComponent& component_of(std::uint32_t triangle) {
        return out_.components[out_.component_of_triangle[triangle]];
    }

    void collect_edges(const std::vector<Side>& sides) {
        for_each_edge(sides, [this](std::span<const Side> edge) {
            for (const Side& side : edge) parts_.unite(edge[0].triangle, side.triangle);
            if (edge.size() == 1) out_.boundary_edges.push_back(edge[0].edge);
            if (edge.size() == 2) links_.push_back({edge[0], edge[1]});
            if (edge.size() > 2) out_.non_manifold_edges.push_back(edge[0].edge);
        });
        for (const Link& link : links_) {
            if (!link.agrees()) out_.inconsistent_edges.push_back(link.left.edge);
        }
    }

    void number_components() {
        out_.component_of_triangle.assign(triangles_.size(), kNone);
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (!has_three_corners(triangles_[t])) continue;
            const std::size_t root = parts_.find(t);
            if (root == t) {
                out_.component_of_triangle[t] = static_cast<std::uint32_t>(out_.components.size());
                out_.components.emplace_back();
            } else {
                out_.component_of_triangle[t] = out_.component_of_triangle[root];
            }
            ++component_of(t).triangle_count;
        }
        has_crowded_edge_.assign(out_.components.size(), false);
    }

    void mark_edges(const std::vector<Side>& sides) {
        for_each_edge(sides, [this](std::span<const Side> edge) {
            TopologyComponent& component = component_of(edge[0].triangle);
            if (edge.size() != 2) component.is_closed = false;
            if (edge.size() <= 2) return;
            component.is_manifold = false;
            has_crowded_edge_[out_.component_of_triangle[edge[0].triangle]] = true;
        });
        for (const Link& link : links_) {
            if (!link.agrees()) component_of(link.left.triangle).is_oriented = false;
        }
    }

    /// The links of every triangle, as offsets into one array.
    void index_links(std::vector<std::size_t>& begin, std::vector<std::size_t>& at) const {
        begin.assign(triangles_.size() + 1, 0);
        for (const Link& link : links_) {
            ++begin[link.left.triangle + 1];
            ++begin[link.right.triangle + 1];
        }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        at.resize(links_.size() * 2);
        std::vector<std::size_t> filled(begin.begin(), begin.end() - 1);
        for (std::size_t i = 0; i < links_.size(); ++i) {
            at[filled[links_[i].left.triangle]++] = i;
            at[filled[links_[i].right.triangle]++] = i;
        }
    }

    /// Turns triangles until neighbours agree, the fewer of those that hang together.
    void orient() {
        std::vector<std::size_t> begin;
        std::vector<std::size_t> at;
        index_links(begin, at);
        out_.is_turned.assign(triangles_.size(), false);
        std::vector<bool> is_reached(triangles_.size(), false);
        std::vector<std::uint32_t> members;
        for (std::uint32_t start = 0; start < triangles_.size(); ++start) {
            if (is_reached[start]) continue;
            members.assign(1, start);
            is_reached[start] = true;
            std::size_t turned = 0;
            for (std::size_t next = 0; next < members.size(); ++next) {
                const std::uint32_t t = members[next];
                turned += out_.is_turned[t] ? 1 : 0;
                for (std::size_t i = begin[t]; i < begin[t + 1]; ++i) {
                    const Link& link = links_[at[i]];
                    const std::uint32_t other =
                        link.left.triangle == t ? link.right.triangle : link.left.triangle;
                    if (is_reached[other]) continue;
                    is_reached[other] = true;
                    out_.is_turned[other] = out_.is_turned[t] == link.agrees();
                    members.push_back(other);
                }
            }
            if (turned * 2 <= members.size()) continue;
            for (const std::uint32_t t : members) out_.is_turned[t] = !out_.is_turned[t];
        }
    }

    /// Corners that meet across an edge share a copy of their vertex.
    void number_copies() {
        for (const Link& link : links_) {
            const bool is_turned_apart =
                out_.is_turned[link.left.triangle] != out_.is_turned[link.right.triangle];
            if (link.agrees() == is_turned_apart) {
                component_of(link.left.triangle).is_orientable = false;
                continue;
            }
            join_corners(fans_, link);
        }
        copy_of_corner_.assign(triangles_.size() * 3, kNone);
        for (std::size_t corner = 0; corner < copy_of_corner_.size(); ++corner) {
            if (!has_three_corners(triangles_[corner / 3])) continue;
            const std::size_t root = fans_.find(corner);
            if (root == corner) {
                copy_of_corner_[corner] = static_cast<std::uint32_t>(out_.vertex_of_copy.size());
                out_.vertex_of_copy.push_back(vertex_at(corner));
            } else {
                copy_of_corner_[corner] = copy_of_corner_[root];
            }
        }
    }

    void join_corners(DisjointSets& sets, const Link& link) const {
        for (const bool at_lower : {true, false}) {
            sets.unite(corner_of(link.left, at_lower), corner_of(link.right, at_lower));
        }
    }

    /// Vertices where several fans of triangles meet, whichever way these wind. Where they belong
    /// to different components, each of these is manifold still.
    void find_non_manifold_vertices() {
        DisjointSets umbrellas(triangles_.size() * 3);
        for (const Link& link : links_) join_corners(umbrellas, link);
        std::vector<std::array<std::uint32_t, 2>> fans;  // vertex, component
        for (std::size_t corner = 0; corner < triangles_.size() * 3; ++corner) {
            const std::uint32_t part = out_.component_of_triangle[corner / 3];
            if (part == kNone || umbrellas.find(corner) != corner) continue;
            fans.push_back({vertex_at(corner), part});
        }
        std::sort(fans.begin(), fans.end());
        for (std::size_t i = 1; i < fans.size(); ++i) {
            if (fans[i][0] != fans[i - 1][0]) continue;
            auto& found = out_.non_manifold_vertices;
            if (found.empty() || found.back() != fans[i][0]) found.push_back(fans[i][0]);
            if (fans[i] == fans[i - 1]) out_.components[fans[i][1]].is_manifold = false;
        }
    }

    std::uint32_t vertex_at(std::size_t corner) const {
        return triangles_[corner / 3][static_cast<int>(corner % 3)];
    }

    static std::size_t corner_of(const Side& side, bool at_lower) {
        const std::size_t corner =
            side.is_forward == at_lower ? side.corner : (side.corner + 1) % 3;
        return std::size_t{side.triangle} * 3 + corner;
    }

    void build_half_edges() {
        const QuietOpenMesh quiet;
        for (std::size_t i = 0; i < out_.vertex_of_copy.size(); ++i) mesh_.add_vertex({});
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (!has_three_corners(triangles_[t])) continue;
            std::array<OpenMesh::VertexHandle, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = OpenMesh::VertexHandle(
                    static_cast<int>(copy_of_corner_[std::size_t{t} * 3 + k]));
            }
            if (out_.is_turned[t]) std::swap(corners[1], corners[2]);
            add_face(t, corners);
        }
    }

    void add_face(std::uint32_t triangle, std::array<OpenMesh::VertexHandle, 3> corners) {
        auto face = mesh_.add_face(corners.data(), corners.size());
        if (!face.is_valid()) {
            // Not known to happen after the cutting above; the triangle then stands alone.
            component_of(triangle).is_manifold = false;
            for (OpenMesh::VertexHandle& corner : corners) {
                out_.vertex_of_copy.push_back(
                    out_.vertex_of_copy[static_cast<std::size_t>(corner.idx())]);
                corner = mesh_.add_vertex({});
            }
            face = mesh_.add_face(corners.data(), corners.size());
            ZSKEL_ASSERT(face.is_valid(), "three new vertices always take a face");
        }
        triangle_of_face_.push_back(triangle);
    }

    TopologyComponent& component_of(OpenMesh::FaceHandle face) {
        return component_of(triangle_of_face_[static_cast<std::size_t>(face.idx())]);
    }

    /// The face beside an edge, on the side where there is one.
    OpenMesh::FaceHandle face_at(OpenMesh::EdgeHandle edge) const {
        const auto face = mesh_.face_handle(mesh_.halfedge_handle(edge, 0));
        return face.is_valid() ? face : mesh_.face_handle(mesh_.halfedge_handle(edge, 1));
    }

    void measure_components() {
        for (const auto face : mesh_.faces()) ++component_of(face).euler_characteristic;
        for (const auto edge : mesh_.edges()) --component_of(face_at(edge)).euler_characteristic;
        for (const auto vertex : mesh_.vertices()) {
            const auto face = mesh_.cvf_iter(vertex);
            if (!face.is_valid()) continue;
            ++component_of(*face).euler_characteristic;
            ++component_of(*face).vertex_count;
        }
    }

    void collect_boundary_loops() {
        std::vector<bool> is_walked(mesh_.n_halfedges(), false);
        for (const auto start : mesh_.halfedges()) {
            if (!mesh_.is_boundary(start) || is_walked[static_cast<std::size_t>(start.idx())])
                continue;
            const std::vector<std::uint32_t> loop = walk_loop(start, is_walked);
            if (!has_boundary_edge(loop)) continue;
            ++component_of(mesh_.face_handle(mesh_.opposite_halfedge_handle(start))).boundary_loops;
            out_.boundary_loops.push_back(loop);
        }
    }

    std::vector<std::uint32_t> walk_loop(OpenMesh::HalfedgeHandle start,
                                         std::vector<bool>& is_walked) const {
        std::vector<std::uint32_t> loop;
        OpenMesh::HalfedgeHandle at = start;
        do {
            is_walked[static_cast<std::size_t>(at.idx())] = true;
            const auto copy = static_cast<std::size_t>(mesh_.to_vertex_handle(at).idx());
            loop.push_back(out_.vertex_of_copy[copy]);
            at = mesh_.next_halfedge_handle(at);
        } while (at != start);
        return loop;
    }

    /// False for a loop that is there only because edges were cut open.
    bool has_boundary_edge(const std::vector<std::uint32_t>& loop) const {
        const auto& edges = out_.boundary_edges;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto [low, high] = std::minmax({loop[i], loop[(i + 1) % loop.size()]});
            const glm::uvec2 edge(low, high);
            if (std::binary_search(edges.begin(), edges.end(), edge, edge_before)) return true;
        }
        return false;
    }

    /// From Euler's formula for an orientable surface with holes: V - E + F = 2 - 2 genus - loops.
    void find_genus() {
        for (std::size_t i = 0; i < out_.components.size(); ++i) {
            TopologyComponent& component = out_.components[i];
            if (!component.is_orientable || has_crowded_edge_[i]) continue;
            const int loops = static_cast<int>(component.boundary_loops);
            component.genus = (2 - component.euler_characteristic - loops) / 2;
        }
    }

    std::size_t vertex_count_;
    std::span<const Triangle> triangles_;
    DisjointSets parts_;
    DisjointSets fans_;
    std::vector<Link> links_;
    std::vector<bool> has_crowded_edge_;
    std::vector<std::uint32_t> copy_of_corner_;
    HalfEdgeMesh mesh_;
    std::vector<std::uint32_t> triangle_of_face_;
    Topology out_;
};

}  // namespace

Topology find_topology(std::size_t vertex_count, std::span<const Triangle> triangles) {
    return TopologyFinder(vertex_count, triangles).find();
}

Topology find_topology(const Mesh& mesh) {
    return find_topology(mesh.positions.size(), mesh.triangles);
}

}  // namespace zskel
