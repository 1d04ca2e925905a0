#include <doctest/doctest.h>

#include <cmath>

#include "support/extract.h"
#include "support/shapes.h"
#include "zskel/core/parallel.h"
#include "zskel/extract.h"
#include "zskel/io/skeleton_formats.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/mesh/solid.h"
#include "zskel/skeleton/spread.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"
#include "zskel/visibility/surface_query.h"

using namespace zskel;

namespace {

std::size_t count_ends(const SkeletonGraph& graph) {
    const auto degrees = node_degrees(graph);
    return static_cast<std::size_t>(std::count(degrees.begin(), degrees.end(), 1u));
}

// Share of points, spread along the edges, that lie inside.
double inside_share(const ExtractResult& result) {
    const SurfaceQuery query(result.surface);
    std::size_t inside = 0;
    std::size_t all = 0;
    for (const SkeletonGraph::Edge& edge : result.graph.edges) {
        const DVec3& a = result.graph.nodes[edge.source].position;
        const DVec3& b = result.graph.nodes[edge.target].position;
        for (int k = 0; k < 8; ++k) {
            const Vec3 p = result.surface.world_from_model.to_world(a + (b - a) * (k / 8.0));
            inside += query.winding_number(p) > 0.5 ? 1 : 0;
            ++all;
        }
    }
    return all == 0 ? 1.0 : static_cast<double>(inside) / static_cast<double>(all);
}

}  // namespace

TEST_CASE("newton: a ball and a cube are one node at the centre") {
    for (const Mesh& mesh : {test::sphere(0.5, 3), test::finer(test::cube())}) {
        const ExtractResult result = test::extract(mesh);
        REQUIRE(result.graph.nodes.size() == 1);
        CHECK(glm::length(result.graph.nodes[0].position) < 0.02);
        CHECK(result.graph.nodes[0].radius == doctest::Approx(0.5).epsilon(0.05));
    }
}

TEST_CASE("newton: a cylinder is one branch along its axis, to near its ends") {
    const ExtractResult result = test::extract(test::cylinder(0.1, 1.0, 32, 33));
    CHECK(count_ends(result.graph) == 2);
    CHECK(graph_topology(result.graph).cycles == 0);
    double low = 1.0;
    double high = -1.0;
    for (const SkeletonGraph::Node& node : result.graph.nodes) {
        CHECK(std::hypot(node.position.x, node.position.y) < 0.01);
        low = std::min(low, node.position.z);
        high = std::max(high, node.position.z);
    }
    CHECK(low < -0.4);
    CHECK(high > 0.4);
}

TEST_CASE("newton: a long tapered cone keeps its whole axis") {
    Mesh cone = test::capped_rings(
        65, 24, [](int i) { return DVec3(0, 0, i / 64.0); },
        [](int i, double angle) {
            const double radius = 0.12 - 0.1 * i / 64.0;
            return DVec3(radius * std::cos(angle), radius * std::sin(angle), i / 64.0);
        });
    const ExtractResult result = test::extract(cone);
    CHECK(count_ends(result.graph) == 2);
    double low = 1.0;
    double high = 0.0;
    for (const SkeletonGraph::Node& node : result.graph.nodes) {
        low = std::min(low, node.position.z);
        high = std::max(high, node.position.z);
    }
    CHECK(low < 0.12);
    CHECK(high > 0.95);
}

TEST_CASE(
    "newton: a vase's axis goes on into its foot, which hardly sticks out of the belly's ball") {
    constexpr double kBelly = 0.3;
    constexpr double kFoot = 0.21;  // radius, and where the foot joins the belly's sphere
    const auto height = [](int i) { return -0.55 + 0.85 * i / 48.0; };
    const Mesh vase = test::capped_rings(
        49, 32, [&](int i) { return DVec3(0, 0, height(i)); },
        [&](int i, double angle) {
            const double z = height(i);
            const double radius =
                std::max(z < 0.0 ? kFoot : 0.02, std::sqrt(std::max(0.0, kBelly * kBelly - z * z)));
            return DVec3(radius * std::cos(angle), radius * std::sin(angle), z);
        });
    const auto lowest = [&](const ExtractOptions& options) {
        double low = 1.0;
        for (const SkeletonGraph::Node& node : test::extract(vase, options).graph.nodes)
            low = std::min(low, node.position.z);
        return low;
    };
    ExtractOptions without;
    without.newton.limbs.fat_area = 1e9;
    CHECK(lowest(without) > -0.1);
    CHECK(lowest({}) < -0.25);
}

TEST_CASE("newton: a flat end is left through its middle, not at a corner") {
    Mesh beam = test::finer(test::cube());
    for (DVec3& p : beam.positions) p = DVec3(0.2 * p.x, 0.2 * p.y, p.z);
    const ExtractResult result = test::extract(beam);
    CHECK(count_ends(result.graph) == 2);
    for (const SkeletonGraph::Node& node : result.graph.nodes)
        CHECK(std::hypot(node.position.x, node.position.y) < 0.02);
}

TEST_CASE("newton: a tetrahedron of any shape has a skeleton in one piece") {
    for (const double width : {1.0, 0.3, 0.1, 0.01}) {
        for (const double height : {1.0, 0.1, 0.001}) {
            Mesh tetrahedron;
            tetrahedron.name = "tetrahedron";
            tetrahedron.positions = {
                {0, 0, 0}, {1, 0, 0}, {0.2, width, 0}, {0.3, 0.2 * width, height}};
            tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
            const ExtractResult result = test::extract(tetrahedron);
            CHECK(graph_topology(result.graph).components == 1);
            CHECK(graph_topology(result.graph).cycles == 0);
            CHECK(count_ends(result.graph) <= 4);
        }
    }
}

TEST_CASE("newton: a torus is one cycle without ends, inside and centred") {
    const ExtractResult result = test::extract(test::torus());
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(graph_topology(result.graph).cycles == 1);
    CHECK(result.statistics.expected_cycles == 1);
    CHECK(count_ends(result.graph) == 0);
    CHECK(inside_share(result) == 1.0);
    for (const SkeletonGraph::Node& node : result.graph.nodes) {
        CHECK(std::hypot(node.position.x, node.position.y) == doctest::Approx(0.35).epsilon(0.05));
    }
    CHECK(result.warnings.empty());
}

TEST_CASE("newton: two rings that meet are two cycles without ends, thick as the middle may be") {
    const ExtractResult result = test::extract(read_mesh(ZSKEL_MODELS "/double_torus.obj"));
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(graph_topology(result.graph).cycles == 2);
    CHECK(count_ends(result.graph) == 0);
}

TEST_CASE("newton: two linked tori are two cycles, each its own") {
    Mesh turned = test::torus();
    for (DVec3& p : turned.positions) p = DVec3(p.x + 0.35, p.z, -p.y);
    const ExtractResult result = test::extract(test::together(test::torus(), turned));
    CHECK(result.statistics.solids == 2);
    CHECK(graph_topology(result.graph).components == 2);
    CHECK(graph_topology(result.graph).cycles == 2);
}

TEST_CASE("newton: at most about five evaluations a seed on a tube") {
    const ExtractResult result = test::extract(test::torus());
    std::size_t sum = 0;
    for (const SeedReport& seed : result.seeds) sum += seed.evaluations;
    CHECK(static_cast<double>(sum) <= 5.0 * static_cast<double>(result.seeds.size()));
}

TEST_CASE("newton: the same at one thread and at many") {
    set_thread_limit(1);
    const ExtractResult one = test::extract(test::torus(0.35, 0.12, 32, 16));
    set_thread_limit(0);
    const ExtractResult many = test::extract(test::torus(0.35, 0.12, 32, 16));
    CHECK(write_skeleton(one.graph, SkeletonFormat::ObjLines) ==
          write_skeleton(many.graph, SkeletonFormat::ObjLines));
    CHECK(one.graph.vertex_node == many.graph.vertex_node);
}

TEST_CASE(
    "spread_seeds: every vertex has a seed that its parents lead to, and none is far from one") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const std::vector<float> even(prepared.surface.positions.size(), 1.0f);
    const SeedSpread spread =
        spread_seeds(prepared.surface, even, {.min_seeds = 100, .max_seeds = 100});
    CHECK(spread.vertices.size() == 100);
    CHECK(spread.end == SpreadEnd::Limit);
    for (std::uint32_t v = 0; v < spread.seed_of.size(); ++v) {
        std::uint32_t at = v;
        while (spread.parent[at] != at) at = spread.parent[at];
        CHECK(at == spread.vertices[spread.seed_of[v]]);
    }
    // The area is 4 pi^2 R r = 1.66 of the model's units (0.94 to a world unit): 100 cells of 0.14
    // across.
    CHECK(spread.spacing_thickness < 0.25);
    const SeedSpread all =
        spread_seeds(prepared.surface, even, {.min_seeds = even.size(), .max_seeds = even.size()});
    CHECK(all.vertices.size() == even.size());
    CHECK(all.end == SpreadEnd::EveryVertex);
    // As many as the spacing asks for, and no more.
    const SeedSpread near =
        spread_seeds(prepared.surface, even, {.min_seeds = 10, .fine_thickness = 0.25});
    CHECK(near.end == SpreadEnd::Spacing);
    CHECK(near.spacing_thickness <= 0.25);
    CHECK(near.vertices.size() < 200);
    // Many will do where they are not so near.
    const SeedSpread many = spread_seeds(
        prepared.surface, even,
        {.min_seeds = 10, .fine_thickness = 0.0, .many_seeds = 15, .coarse_thickness = 0.5});
    CHECK(many.end == SpreadEnd::Spacing);
    CHECK(many.vertices.size() >= 15);
    CHECK(many.vertices.size() < near.vertices.size());
    CHECK(many.spacing_thickness <= 0.5);
}
