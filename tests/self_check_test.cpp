#include <doctest/doctest.h>

#include "support/shapes.h"
#include "zskel/self_check.h"

using namespace zskel;

namespace {

// A skeleton of one solid, drawn by hand in model space.
SelfCheck check_of(const Mesh& mesh, const std::vector<DVec3>& places,
                   const std::vector<glm::uvec2>& edges, std::size_t expected_cycles) {
    const PreparedSurface prepared = prepare_surface(mesh, WorldSize::Spread);
    const std::vector<Solid> solids = split_solids(prepared);
    REQUIRE(solids.size() == 1);
    SolidSkeleton skeleton;
    SkeletonGraph graph;
    for (const DVec3& p : places) {
        skeleton.nodes.push_back(prepared.surface.world_from_model.to_world(p));
        graph.nodes.push_back({p, 0.1, 0});
    }
    skeleton.edges = edges;
    for (const glm::uvec2& edge : edges) graph.edges.push_back({edge.x, edge.y});
    skeleton.expected_cycles = expected_cycles;
    skeleton.knows_cycles = true;
    SkeletonChecker checker;
    checker.add(solids[0], SurfaceQuery(solids[0].surface), skeleton);
    return checker.finish(graph);
}

}  // namespace

TEST_CASE("self-check: a chain on a cylinder's axis is sound, with its clearance") {
    const SelfCheck check = check_of(test::cylinder(0.1, 1.0),
                                     {{0, 0, -0.3}, {0, 0, 0}, {0, 0, 0.3}}, {{0, 1}, {1, 2}}, 0);
    CHECK(check.failures.empty());
    CHECK(*check.share_inside == 1.0);
    CHECK(check.least_clearance == doctest::Approx(0.1).epsilon(0.01));
}

TEST_CASE("self-check: what leaves the solid is measured and named") {
    const SelfCheck check =
        check_of(test::cylinder(0.1, 1.0), {{0, 0, 0}, {0.4, 0, 0}}, {{0, 1}}, 0);
    CHECK(*check.share_inside == doctest::Approx(0.25).epsilon(0.02));
    CHECK(check.least_clearance < 0.0);
    REQUIRE(check.failures.size() == 1);
    CHECK(check.failures[0].find("inside") != std::string::npos);
}

TEST_CASE("self-check: a cycle that is missing and a part too many") {
    const SelfCheck ring = check_of(test::torus(), {{0.35, 0, 0}, {0.34, 0.05, 0}}, {{0, 1}}, 1);
    CHECK(ring.failures.size() == 1);
    const SelfCheck parts = check_of(test::cylinder(0.1, 1.0), {{0, 0, -0.3}, {0, 0, 0.3}}, {}, 0);
    CHECK(parts.failures.size() == 1);
    CHECK(parts.components == 2);
}
