// Our meshing of what a skeleton's nodes see beside a library's: CGAL's Poisson reconstruction of
// the same points with normals, as `zskel reconstruct --points` writes them, and CGAL's surface
// mesher asking the same function as our marching tetrahedra.
// Once tools/bench/run has configured:
//   cmake --build --preset release -j 1 --target zskel_bench_rebuild
//   build/release/tools/bench/zskel_bench_rebuild MODEL...
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/make_surface_mesh.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <unordered_map>

#include "seconds_of.h"
#include "zskel/core/error.h"
#include "zskel/core/lattice_hash.h"
#include "zskel/core/log.h"
#include "zskel/extract.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/level_set.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/rebuild/fidelity.h"
#include "zskel/rebuild/watertight.h"

namespace zskel::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointAndNormal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

constexpr unsigned kNeighbours = 6;    // as CGAL's manual takes the spacing
constexpr double kRootError = 1e-3;    // of the diagonal
constexpr double kLeastAngle = 20.0;   // degrees; CGAL ends for no more than 30
constexpr double kLargestFacet = 4.0;  // voxels
constexpr double kFarthest = 0.5;      // voxels
constexpr int kMapPx = 32;             // as zskel reconstruct

std::vector<PointAndNormal> points_of(const std::vector<Surfel>& surfels) {
    std::vector<PointAndNormal> points;
    for (const Surfel& s : surfels) {
        points.emplace_back(Kernel::Point_3(s.position.x, s.position.y, s.position.z),
                            Kernel::Vector_3(s.normal.x, s.normal.y, s.normal.z));
    }
    return points;
}

Mesh mesh_of(const Polyhedron& polyhedron) {
    Mesh mesh;
    std::unordered_map<const void*, std::uint32_t> number_of;
    for (auto v = polyhedron.vertices_begin(); v != polyhedron.vertices_end(); ++v) {
        number_of.emplace(&*v, static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.emplace_back(v->point().x(), v->point().y(), v->point().z());
    }
    for (auto f = polyhedron.facets_begin(); f != polyhedron.facets_end(); ++f) {
        const auto h = f->halfedge();
        mesh.triangles.emplace_back(number_of.at(&*h->vertex()),
                                    number_of.at(&*h->next()->vertex()),
                                    number_of.at(&*h->next()->next()->vertex()));
    }
    return mesh;
}

// With the settings of CGAL's own function. Throws InputError when it makes nothing.
Mesh poisson(const std::vector<PointAndNormal>& points) {
    const CGAL::First_of_pair_property_map<PointAndNormal> place;
    const CGAL::Second_of_pair_property_map<PointAndNormal> normal;
    const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(
        points, kNeighbours, CGAL::parameters::point_map(place));
    Polyhedron out;
    if (!CGAL::poisson_surface_reconstruction_delaunay(points.begin(), points.end(), place, normal,
                                                       out, spacing)) {
        throw InputError("CGAL made no surface");
    }
    return mesh_of(out);
}

// Asks the maps about the places of one cube after the other, as marching tetrahedra do.
class Inside {
  public:
    Inside(const Recall& recall, double side) : recall_(&recall), side_(side) {}
    double at(const DVec3& place) {
        const glm::i64vec3 cube(glm::floor(place / side_));
        const auto [found, is_new] = among_.try_emplace(cube);
        if (is_new) {
            found->second = recall_->maps_about((DVec3(cube) + 0.5) * side_, 0.5 * side_);
        }
        return found->second.empty() ? -side_ : recall_->inside(place, found->second);
    }

  private:
    const Recall* recall_;
    double side_;
    std::unordered_map<glm::i64vec3, std::vector<std::uint32_t>, LatticeHash> among_;
};

// Facets as far from the surface as ours at most, no smaller than that asks for.
Mesh surface_mesher(const Recall& recall, const DVec3& inside_place, double diagonal,
                    double voxel) {
    using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
    using Traits = Triangulation::Geom_traits;
    using Function = std::function<Traits::FT(const Traits::Point_3&)>;
    Inside inside(recall, kLevelSetBlock * voxel);
    Triangulation triangulation;
    CGAL::Complex_2_in_triangulation_3<Triangulation> facets(triangulation);
    const CGAL::Implicit_surface_3<Traits, Function> surface(
        [&](const Traits::Point_3& p) { return -inside.at(DVec3(p.x(), p.y(), p.z())); },
        Traits::Sphere_3(Traits::Point_3(inside_place.x, inside_place.y, inside_place.z),
                         diagonal * diagonal),
        kRootError);
    const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(
        kLeastAngle, kLargestFacet * voxel, kFarthest * voxel);
    CGAL::make_surface_mesh(facets, surface, criteria, CGAL::Manifold_tag());
    Polyhedron out;
    CGAL::facets_in_complex_2_to_triangle_mesh(facets, out);
    return mesh_of(out);
}

void print_row(const char* name, double seconds, const Mesh& rebuilt, const Mesh& original) {
    const double diagonal = box_of(original.positions).diagonal();
    const SurfaceDistances distances = distances_between(original, rebuilt);
    fmt::print("  {:<8} {:>7.2f} s {:>8} faces  mean {:.3f} %  Hausdorff {:.2f} %\n", name, seconds,
               rebuilt.triangles.size(), 100.0 * distances.mean / diagonal,
               100.0 * distances.hausdorff / diagonal);
    std::fflush(stdout);
}

void run(const std::string& path) {
    const Mesh original = read_mesh(path);
    const auto nodes = open_backend({});
    const SkeletonGraph graph = extract_skeleton(original, {}, *nodes).graph;
    BackendOptions options;
    options.face_px = kMapPx;
    const VisibilityMaps maps = look_from_nodes(original, graph, *open_backend(options));
    RebuiltMesh ours;
    const double our_seconds = seconds_of([&] { ours = rebuild_surface(maps, {}); });
    Mesh mesh;
    mesh.positions = ours.positions;
    mesh.triangles = ours.triangles;
    const Recall recall(maps);
    const std::vector<PointAndNormal> points =
        points_of(merge_surfels(recall.surfels(), ours.voxel));
    Mesh fitted;
    const double poisson_seconds = seconds_of([&] { fitted = poisson(points); });
    const auto widest =
        std::max_element(graph.nodes.begin(), graph.nodes.end(),
                         [](const auto& l, const auto& r) { return l.radius < r.radius; });
    Mesh meshed;
    const double mesher_seconds = seconds_of([&] {
        meshed = surface_mesher(recall, widest->position, box_of(original.positions).diagonal(),
                                ours.voxel);
    });
    fmt::print("{}: {} nodes, {} points\n", std::filesystem::path(path).stem().string(),
               maps.nodes.size(), points.size());
    print_row("zskel", our_seconds, mesh, original);
    print_row("Poisson", poisson_seconds, fitted, original);
    print_row("mesher", mesher_seconds, meshed, original);
}

}  // namespace
}  // namespace zskel::bench

int main(int argc, char** argv) {
    using namespace zskel;
    set_log(LogLevel::Error, LogFormat::Text);
    try {
        for (int i = 1; i < argc; ++i) bench::run(argv[i]);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
