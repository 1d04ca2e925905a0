#include <doctest/doctest.h>

#include "support/drawn_graph.h"
#include "zskel/skeleton/zip.h"

using namespace zskel;
using test::draw;
using test::Ends;
using test::ends_of;
using test::Tube;

TEST_CASE(
    "zip_branches: a limb is joined where it leaves its body, not where it was joined first") {
    const Tube tube;
    const float r = tube.radius;
    CurveGraph graph;
    const std::uint32_t joint = graph.add({0, 0, -2 * r});
    draw(graph, joint, {{0, 0, -3 * r}});
    draw(graph, joint, {{0, 0, 3 * r}});
    draw(graph, joint, {{0.1f * r, 0, -1.9f * r}, {0.1f * r, 0, 0}, {0.8f * r, 0, 0.4f * r}});
    const Ends before = ends_of(graph);
    CHECK(zip_branches(graph, tube.query, {}) == 1);
    const Ends after = ends_of(graph);
    REQUIRE(after.junctions.size() == 1);
    CHECK(after.junctions[0].x == doctest::Approx(0.0f));
    CHECK(std::abs(after.junctions[0].z) < 0.5f * r);
    CHECK(after.ends == before.ends);
    CHECK(after.branches == before.branches);
    CHECK(after.seeds == before.seeds);
}

TEST_CASE("zip_branches: a limb that goes on beside what begins at the next junction comes along") {
    const Tube tube;
    const float r = tube.radius;
    CurveGraph graph;
    const std::uint32_t joint = graph.add({0, 0, -2 * r});
    draw(graph, joint, {{0, 0, -3 * r}});
    const std::uint32_t near = draw(graph, joint, {{0, 0, -1.6f * r}});
    draw(graph, near, {{0, 0.8f * r, -1.5f * r}});
    draw(graph, near, {{0, 0, 3 * r}});
    draw(graph, joint, {{0.1f * r, 0, -1.9f * r}, {0.1f * r, 0, 0}, {0.8f * r, 0, 0.4f * r}});
    const Ends before = ends_of(graph);
    CHECK(zip_branches(graph, tube.query, {}) == 2);
    const Ends after = ends_of(graph);
    REQUIRE(after.junctions.size() == 2);
    CHECK(after.junctions[0] == graph.at(near));
    CHECK(std::abs(after.junctions[1].z) < 0.5f * r);
    CHECK(after.ends == before.ends);
    CHECK(after.seeds == before.seeds);
}

TEST_CASE("zip_branches: what parts at once stays, and so do an end beside a branch, and a cycle") {
    const Tube tube;
    const float r = tube.radius;
    const auto zipped = [&](std::initializer_list<Vec3> second) {
        CurveGraph graph;
        const std::uint32_t joint = graph.add({0, 0, -2 * r});
        draw(graph, joint, {{0, 0, -3 * r}});
        draw(graph, joint, {{0, 0, 3 * r}});
        draw(graph, joint, second);
        return zip_branches(graph, tube.query, {});
    };
    CHECK(zipped({{0.8f * r, 0, -1.5f * r}}) == 0);
    CHECK(zipped({{0.1f * r, 0, -1.9f * r}, {0.1f * r, 0, 0}}) == 0);

    CurveGraph ring;
    const std::uint32_t joint = ring.add({0, 0, -2 * r});
    const std::uint32_t other = draw(ring, joint, {{0, 0, 2 * r}});
    ring.link(draw(ring, joint, {{0.1f * r, 0, 0}, {0.05f * r, 0, 1.8f * r}}), other);
    draw(ring, joint, {{0, 0, -3 * r}});
    draw(ring, other, {{0, 0, 3 * r}});
    zip_branches(ring, tube.query, {});
    const Ends after = ends_of(ring);
    CHECK(after.ends == 2);
    CHECK(after.branches == 4);  // two of them round
}
