#include <doctest/doctest.h>

#include "zskel/skeleton/cluster.h"
#include "zskel/skeleton/connect.h"
#include "zskel/skeleton/graph.h"
#include "zskel/skeleton/settle.h"

#include "support/shapes.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"
#include "zskel/visibility/surface_query.h"

using namespace zskel;

namespace {

struct Line {
    std::vector<Vec3> points;
    std::vector<glm::uvec2> links;
};

Line line_of(std::size_t count, float spacing) {
    Line line;
    for (std::uint32_t i = 0; i < count; ++i) {
        line.points.emplace_back(spacing * static_cast<float>(i), 0.0f, 0.0f);
        if (i > 0) line.links.emplace_back(i - 1, i);
    }
    return line;
}

}  // namespace

TEST_CASE("cluster_minima: a chain of near points is cut into clusters about one range apart") {
    const Line line = line_of(101, 0.01f);  // a limb one unit long
    const Clusters clusters = cluster_minima(line.points, line.links, {0.1});
    for (std::size_t i = 1; i < clusters.centers.size(); ++i) {
        CHECK(glm::distance(clusters.centers[i - 1], clusters.centers[i]) > 0.1f * (1.0f - 1e-5f));
    }
    CHECK(clusters.centers.size() >= 4);
    CHECK(clusters.centers.size() <= 10);
}

TEST_CASE("cluster_minima: near points that no link joins stay apart") {
    const std::vector<Vec3> points{{0, 0, 0}, {0.001f, 0, 0}};
    CHECK(cluster_minima(points, {}, {0.1}).centers.size() == 2);
    const std::vector<glm::uvec2> link{{0, 1}};
    const Clusters one = cluster_minima(points, link, {0.1});
    REQUIRE(one.centers.size() == 1);
    CHECK(one.centers[0].x == doctest::Approx(0.0005f));
}

TEST_CASE("cluster_minima: a range of zero joins only equal points") {
    const std::vector<Vec3> points{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    const std::vector<glm::uvec2> links{{0, 1}, {1, 2}};
    CHECK(cluster_minima(points, links, {0.0}).of_point == std::vector<std::uint32_t>{0, 0, 1});
}

TEST_CASE("connect_clusters: an edge for each pair of clusters that a link joins, each once") {
    const std::vector<std::uint32_t> of_point{2, 2, 0, 1};
    const std::vector<glm::uvec2> links{{0, 1}, {0, 2}, {1, 2}, {2, 3}};
    const auto edges = connect_clusters(of_point, links);
    REQUIRE(edges.size() == 2);
    CHECK(edges[0] == glm::uvec2(0, 1));
    CHECK(edges[1] == glm::uvec2(0, 2));
}

TEST_CASE("spanning_forest: opens a cycle at its longest edge and keeps parts apart") {
    const std::vector<Vec3> centers{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {9, 9, 9}, {8, 9, 9}};
    const std::vector<glm::uvec2> edges{{0, 1}, {0, 2}, {1, 2}, {3, 4}};
    const auto kept = spanning_forest(centers, edges);
    REQUIRE(kept.size() == 3);
    CHECK(kept[0] == glm::uvec2(0, 1));
    CHECK(kept[1] == glm::uvec2(0, 2));
    CHECK(kept[2] == glm::uvec2(3, 4));
}

TEST_CASE("graph_topology: components and cycles") {
    SkeletonGraph graph;
    graph.nodes.resize(5);
    graph.edges = {{0, 1}, {0, 2}, {1, 2}, {3, 4}};
    CHECK(graph_topology(graph).components == 2);
    CHECK(graph_topology(graph).cycles == 1);
    CHECK(node_degrees(graph) == std::vector<std::uint32_t>{2, 2, 2, 1, 1});
}

TEST_CASE("vertex_thickness: of a fine mesh too it is the free way straight in") {
    // A long ball: thick in its middle, thin towards its tips.
    Mesh mesh = test::sphere(0.5, 7);
    for (DVec3& p : mesh.positions) p.x *= 4.0;
    const PreparedSurface prepared = prepare_surface(mesh);
    REQUIRE(prepared.surface.positions.size() > 50000);
    const SurfaceQuery query(prepared.surface);
    const std::vector<float> thickness = vertex_thickness(prepared.surface, query);
    std::size_t taken = 0;
    std::size_t off = 0;
    for (std::size_t v = 0; v < thickness.size(); ++v) {
        const Vec3 inward = -prepared.surface.vertex_normals[v];
        const float looked = query.free_way(prepared.surface.positions[v] + inward * 1e-5f, inward);
        if (thickness[v] != looked) ++taken;
        if (std::abs(thickness[v] - looked) > 0.06f * looked) ++off;
    }
    CHECK(off < thickness.size() / 100);  // at the tips, where ways along the ball are the longest
    CHECK(taken > thickness.size() / 2);  // from neighbours
    CHECK(taken < thickness.size() * 4 / 5);
}

TEST_CASE("place_seeds: inside, at the offset, and no deeper than the thickness allows") {
    const PreparedSurface thick = prepare_surface(test::sphere(0.5, 3));
    const SurfaceQuery query(thick.surface);
    for (const Seed& seed : place_seeds(thick.surface, query, {})) {
        CHECK(query.winding_number(seed.position) == doctest::Approx(1.0));
        CHECK(query.nearest(seed.position).distance == doctest::Approx(0.005).epsilon(0.05));
    }
    Mesh plate = test::sphere(0.5, 3);
    for (DVec3& p : plate.positions) p.z *= 0.004;
    const PreparedSurface thin = prepare_surface(plate);
    const SurfaceQuery thin_query(thin.surface);
    std::size_t inside = 0;
    const auto seeds = place_seeds(thin.surface, thin_query, {});
    for (const Seed& seed : seeds) inside += thin_query.winding_number(seed.position) > 0.5 ? 1 : 0;
    CHECK(inside == seeds.size());
}

TEST_CASE(
    "settle_seeds: from every corner of the cube to its centre, within one step (the paper's "
    "Figure 3)") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const auto source = make_ray_source(prepared.surface, cube_directions(16));
    const SurfaceQuery query(prepared.surface);
    const auto seeds = place_seeds(prepared.surface, query, {});
    PaperStepOptions options;
    options.keep_paths = true;
    for (const SettledSeed& seed : settle_seeds(*source, seeds, options)) {
        CHECK(seed.state == SeedState::Converged);
        CHECK(glm::length(seed.position) <= options.step_world);
        CHECK(seed.path.size() == seed.steps + 1);
        CHECK(seed.path.back() == seed.position);
        // The start, every step, and the step beyond, unless no force is left there.
        CHECK(seed.evaluations >= seed.steps + 1);
        CHECK(seed.evaluations <= seed.steps + 2);
    }
}

TEST_CASE(
    "settle_seeds: no step is taken that raises the force, and each has the length of a step") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const auto source = make_ray_source(prepared.surface, cube_directions(8));
    const SurfaceQuery query(prepared.surface);
    auto seeds = place_seeds(prepared.surface, query, {});
    seeds.resize(40);
    PaperStepOptions options;
    options.keep_paths = true;
    for (const SettledSeed& seed : settle_seeds(*source, seeds, options)) {
        std::vector<EyeRecord> met(seed.path.size());
        source->look(seed.path, met);
        for (std::size_t i = 1; i < met.size(); ++i) {
            CHECK(glm::length(met[i].force) <= glm::length(met[i - 1].force));
            CHECK(glm::distance(seed.path[i], seed.path[i - 1]) ==
                  doctest::Approx(options.step_world).epsilon(1e-3));
        }
    }
}

TEST_CASE(
    "settle_seeds: says when the step limit stopped a seed, when it is outside, and when it sees "
    "nothing") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const auto source = make_ray_source(prepared.surface, cube_directions(8));
    PaperStepOptions options;
    options.max_steps = 3;
    const std::vector<Seed> seeds{
        {{0.4f, 0.3f, 0.2f}, 0}, {{0.7f, 0.0f, 0.0f}, 1}, {{90.0f, 90.0f, 90.0f}, 2}};
    const auto settled = settle_seeds(*source, seeds, options);
    CHECK(settled[0].state == SeedState::StepLimit);
    CHECK(settled[0].steps == 3);
    CHECK(settled[1].state == SeedState::LeftMesh);
    CHECK(settled[2].state == SeedState::NoHits);
    CHECK(settled[2].position == seeds[2].position);
}
