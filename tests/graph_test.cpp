#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "support/box.h"
#include "zskel/skeleton/graph.h"
#include "zskel/skeleton/volumes.h"

using namespace zskel;

namespace {

SkeletonGraph graph_of(const std::vector<DVec3>& places,
                       const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
    SkeletonGraph graph;
    for (const DVec3& p : places) graph.nodes.push_back({p, 0.5, 0});
    for (const auto& [a, b] : edges) graph.edges.push_back({a, b});
    return graph;
}

}  // namespace

TEST_CASE("branches run from junctions to ends, with lengths and tortuosity") {
    // A Y whose stem is bent by a right angle.
    const SkeletonGraph graph = graph_of({{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -3, 0}, {4, -3, 0}},
                                         {{0, 1}, {0, 2}, {0, 3}, {3, 4}});
    const std::vector<Branch> branches = find_branches(graph);
    REQUIRE(branches.size() == 3);
    const Branch& stem = branches[2];
    CHECK(stem.nodes == std::vector<std::uint32_t>{0, 3, 4});
    CHECK(stem.start_degree == 3);
    CHECK(stem.stop_degree == 1);
    CHECK(stem.length == doctest::Approx(7.0));
    CHECK(stem.tortuosity == doctest::Approx(1.4));
    CHECK(stem.mean_radius == doctest::Approx(0.5));
}

TEST_CASE("a ring is one branch that comes back, a lone node none") {
    const SkeletonGraph ring =
        graph_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1}, {1, 2}, {0, 2}});
    const std::vector<Branch> branches = find_branches(ring);
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].is_ring);
    CHECK(branches[0].nodes == std::vector<std::uint32_t>{0, 1, 2, 0});
    CHECK(std::isinf(branches[0].tortuosity));
}

TEST_CASE("the volumes of a box's nodes are its parts and sum to its volume") {
    const Surface box =
        prepare_surface(test::make_box(DVec3(-2, -1, -1), DVec3(2, 1, 1)), WorldSize::Spread)
            .surface;
    const std::vector<Vec3> nodes{box.world_from_model.to_world(DVec3(-1, 0, 0)),
                                  box.world_from_model.to_world(DVec3(1, 0, 0))};
    std::vector<std::uint32_t> vertex_node;
    for (const Vec3& p : box.positions) vertex_node.push_back(p.x < 0.0f ? 0 : 1);
    const std::vector<double> volumes = node_volumes(box, vertex_node, nodes);
    const double unit = std::pow(box.world_from_model.length_to_model(1.0), 3.0);
    CHECK((volumes[0] + volumes[1]) * unit == doctest::Approx(16.0).epsilon(1e-5));
    // Two triangles a side: the shares follow their diagonals.
    CHECK(volumes[0] * unit == doctest::Approx(8.0).epsilon(0.06));
    CHECK(volumes[1] * unit == doctest::Approx(8.0).epsilon(0.06));
}
