#include "zskel/io/tubes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "support/odd_graph.h"

using namespace zskel;
using test::odd_graph;

TEST_CASE("tube_surface: closed, oriented, around its nodes") {
    const SkeletonGraph graph = odd_graph();
    const TubeSurface tubes = tube_surface(graph, 8);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const Triangle& t : tubes.triangles) {
        for (int i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [side, count] : sides) {
        CHECK(count == 1);
        CHECK(sides.contains({side.second, side.first}));
    }
    for (std::size_t i = 0; i < tubes.positions.size(); ++i) {
        const SkeletonGraph::Node& node = graph.nodes[tubes.node[i]];
        const double slack = 1e-15 * glm::length(node.position) + 1e-15;
        CHECK(std::abs(glm::distance(tubes.positions[i], node.position) - node.radius) < slack * 4);
    }
}

TEST_CASE("tube_surface: a straight tube holds a prism and two half balls") {
    SkeletonGraph graph;
    graph.nodes = {{{0, 0, 0}, 1, 0, 0}, {{0, 5, 0}, 1, 0, 0}, {{0, 10, 0}, 1, 0, 0}};
    graph.edges = {{0, 1}, {1, 2}};
    const TubeSurface tubes = tube_surface(graph, 64);
    double volume = 0.0;
    for (const Triangle& t : tubes.triangles) {
        volume +=
            glm::dot(tubes.positions[t.x], glm::cross(tubes.positions[t.y], tubes.positions[t.z])) /
            6.0;
    }
    const double full = std::numbers::pi * (10.0 + 4.0 / 3.0);
    CHECK(volume < full);
    CHECK(volume > 0.98 * full);
}
