// Decimation by collapses that keep the topology (OpenMesh): first those that make short edges, in
// units of the length that suits the place, and keep to the planes (quadrics: Garland and Heckbert
// 1997). Then rounds of edge flips and tangential smoothing (Botsch and Kobbelt 2004), pulled back
// to the field. No step may turn a triangle over.
#include "remesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>  // before QuadricT.hh, which needs it

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace zskel::models {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

constexpr int kRelaxRounds = 12;
constexpr double kPull = 0.7;             // share of the way to the middle, a round
constexpr double kMaxFlipDegrees = 60.0;  // that a collapse may turn a face
constexpr double kRoundLengths = 1.05;    // longest suited edge in radii: six to a round
constexpr double kPlaneWeight = 1.0;
constexpr double kMaxTurn = 0.4;  // least cosine between a face's normal before and after

glm::dvec3 to_glm(const OpenMesh::Vec3d& v) {
    return {v[0], v[1], v[2]};
}
OpenMesh::Vec3d to_openmesh(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Mesh to_mesh(const Triangles& triangles) {
    Mesh mesh;
    for (const glm::dvec3& v : triangles.vertices) {
        mesh.add_vertex(to_openmesh(v));
    }
    for (const glm::uvec3& f : triangles.faces) {
        mesh.add_face(mesh.vertex_handle(f.x), mesh.vertex_handle(f.y), mesh.vertex_handle(f.z));
    }
    return mesh;
}

Triangles to_triangles(const Mesh& mesh) {
    Triangles triangles;
    for (const auto v : mesh.vertices()) {
        triangles.vertices.push_back(to_glm(mesh.point(v)));
    }
    for (const auto f : mesh.faces()) {
        glm::uvec3 face;
        int i = 0;
        for (const auto v : f.vertices()) {
            face[i++] = static_cast<unsigned>(v.idx());
        }
        triangles.faces.push_back(face);
    }
    return triangles;
}

/// Edge length that suits each place: it grows with the square root of the limb's radius, so thin
/// limbs get more triangles a round than their area asks for, and never exceeds what keeps a limb
/// round.
class SuitedLength {
  public:
    /// Sets the factor so that the whole mesh takes about `faces` triangles.
    SuitedLength(const Mesh& mesh, const Field& field, std::size_t faces) : field_(field) {
        for (int round = 0; round < 8; ++round) {
            double wanted = 0.0;
            for (const auto f : mesh.faces()) {
                const double length = at(to_glm(mesh.calc_face_centroid(f)));
                wanted += mesh.calc_face_area(f) / (0.25 * std::sqrt(3.0) * length * length);
            }
            factor_ *= std::sqrt(wanted / static_cast<double>(faces));
        }
    }

    double at(const glm::dvec3& p) const {
        const double radius = field_.radius(p);
        return std::min(factor_ * std::sqrt(radius), kRoundLengths * radius);
    }

    /// How far vertices stand out, for chords of that length to keep the volume of the round limb.
    double standing_out(const glm::dvec3& p) const {
        const double length = at(p);
        return length * length / (12.0 * field_.radius(p));
    }

  private:
    const Field& field_;
    double factor_ = 0.1;
};

/// Rates a collapse by the longest edge that it makes, in suited lengths, and by how far the kept
/// vertex is from the planes of all the triangles that it stands for.
template <class MeshT>
class ModSuited : public OpenMesh::Decimater::ModBaseT<MeshT> {
  public:
    DECIMATING_MODULE(ModSuited, MeshT, Suited);

    explicit ModSuited(MeshT& mesh) : Base(mesh, false) {}

    void measure(const SuitedLength& suited) {
        const MeshT& mesh = Base::mesh();
        quadrics_.assign(mesh.n_vertices(), {});
        for (const auto v : mesh.vertices()) {
            lengths_.push_back(suited.at(to_glm(mesh.point(v))));
            for (const auto f : v.faces()) {
                const auto n = mesh.normal(f);
                quadrics_[index(v)] += Quadric(n[0], n[1], n[2], -(n | mesh.point(v)));
            }
        }
    }

    float collapse_priority(const CollapseInfo& collapse) override {
        const double suited = std::min(lengths_[index(collapse.v0)], lengths_[index(collapse.v1)]);
        double longest = 0.0;
        for (const auto neighbour : Base::mesh().vv_range(collapse.v0)) {
            longest = std::max(longest, (Base::mesh().point(neighbour) - collapse.p1).sqrnorm());
        }
        const Quadric planes = quadrics_[index(collapse.v0)] + quadrics_[index(collapse.v1)];
        return static_cast<float>((longest + kPlaneWeight * planes(collapse.p1)) /
                                  (suited * suited));
    }

    void postprocess_collapse(const CollapseInfo& collapse) override {
        quadrics_[index(collapse.v1)] += quadrics_[index(collapse.v0)];
    }

  private:
    using Quadric = OpenMesh::Geometry::QuadricT<double>;

    static std::size_t index(const OpenMesh::VertexHandle& v) {
        return static_cast<std::size_t>(v.idx());
    }

    std::vector<double> lengths_;
    std::vector<Quadric> quadrics_;
};

void decimate(Mesh& mesh, const SuitedLength& suited, std::size_t target_faces) {
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    mesh.request_face_normals();
    mesh.update_face_normals();
    {
        OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
        ModSuited<Mesh>::Handle rating;
        OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flipping;
        decimater.add(rating);
        decimater.add(flipping);
        decimater.module(rating).measure(suited);
        decimater.module(flipping).set_max_normal_deviation(kMaxFlipDegrees);
        decimater.initialize();
        decimater.decimate_to_faces(0, target_faces);
    }
    mesh.garbage_collection();
}

glm::dvec3 normal_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    return n / std::max(glm::length(n), 1e-30);
}

/// Least angle of a triangle, as the cosine of it negated: larger is better.
double least_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto cosine = [](const glm::dvec3& u, const glm::dvec3& v) {
        return glm::dot(u, v) / std::max(glm::length(u) * glm::length(v), 1e-30);
    };
    return -std::max({cosine(b - a, c - a), cosine(c - b, a - b), cosine(a - c, b - c)});
}

/// Flips the edges whose two triangles get a larger least angle by it and stay as flat.
void flip_edges(Mesh& mesh) {
    for (const auto e : mesh.edges()) {
        if (!mesh.is_flip_ok(e)) {
            continue;
        }
        const auto h = e.h0();
        const glm::dvec3 a = to_glm(mesh.point(h.from())), b = to_glm(mesh.point(h.to()));
        const glm::dvec3 c = to_glm(mesh.point(h.next().to()));
        const glm::dvec3 d = to_glm(mesh.point(h.opp().next().to()));
        const double flat_before = glm::dot(normal_of(a, b, c), normal_of(b, a, d));
        const double flat_after = glm::dot(normal_of(c, d, b), normal_of(d, c, a));
        const double before = std::min(least_angle(a, b, c), least_angle(b, a, d));
        const double after = std::min(least_angle(c, d, b), least_angle(d, c, a));
        if (after > before && flat_after > std::min(flat_before, 0.9) - 0.1) {
            mesh.flip(e);
        }
    }
}

bool turns_a_face(const Mesh& mesh, const OpenMesh::SmartVertexHandle& v,
                  const glm::dvec3& target) {
    const glm::dvec3 p = to_glm(mesh.point(v));
    for (const auto h : v.outgoing_halfedges()) {
        const glm::dvec3 a = to_glm(mesh.point(h.to())), b = to_glm(mesh.point(h.next().to()));
        if (glm::dot(normal_of(p, a, b), normal_of(target, a, b)) < kMaxTurn) {
            return true;
        }
    }
    return false;
}

/// Moves every vertex toward the middle of its faces, along the surface only. Faces weigh by area
/// and by the density that the suited length asks for, which is what centroidal Voronoi cells
/// settle to.
void smooth(Mesh& mesh, const Field& field, const SuitedLength& suited) {
    for (const auto v : mesh.vertices()) {
        const glm::dvec3 p = to_glm(mesh.point(v));
        glm::dvec3 middle(0.0);
        double total = 0.0;
        for (const auto h : v.outgoing_halfedges()) {
            const glm::dvec3 centre =
                (p + to_glm(mesh.point(h.to())) + to_glm(mesh.point(h.next().to()))) / 3.0;
            const double weight = mesh.calc_sector_area(h) / std::pow(suited.at(centre), 4.0);
            middle += weight * centre;
            total += weight;
        }
        const glm::dvec3 normal = field.normal(p);
        const glm::dvec3 pull = middle / total - p;
        const glm::dvec3 moved = p + kPull * (pull - glm::dot(pull, normal) * normal);
        const glm::dvec3 target = field.project(moved, suited.standing_out(moved));
        if (!turns_a_face(mesh, v, target)) {
            mesh.set_point(v, to_openmesh(target));
        }
    }
}

}  // namespace

Triangles remesh(const Triangles& triangles, const Field& field, std::size_t target_faces) {
    Mesh mesh = to_mesh(triangles);
    const SuitedLength suited(mesh, field, target_faces);
    decimate(mesh, suited, target_faces);
    for (int round = 0; round < kRelaxRounds; ++round) {
        flip_edges(mesh);
        smooth(mesh, field, suited);
    }
    return to_triangles(mesh);
}

}  // namespace zskel::models
