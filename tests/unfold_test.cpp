#include <doctest/doctest.h>

#include "support/drawn_graph.h"
#include "zskel/skeleton/unfold.h"

using namespace zskel;
using test::draw;
using test::Ends;
using test::ends_of;
using test::Tube;

TEST_CASE("unfold_branches: a way out and back beside itself becomes a limb with an end") {
    const Tube tube;
    const float r = tube.radius;
    for (const bool has_third : {false, true}) {
        CAPTURE(has_third);
        CurveGraph graph;
        const std::uint32_t tip = graph.add({0, 0, 3 * r}, r);
        draw(graph, tip, {{0, 0, -3 * r}});
        draw(graph, tip, {{0.1f * r, 0, 0}, {0.8f * r, 0, -0.4f * r}});
        if (has_third) draw(graph, tip, {{-0.1f * r, 0, 0.2f * r}, {-0.8f * r, 0, -0.2f * r}});
        const Ends before = ends_of(graph);
        REQUIRE(before.ends == (has_third ? 3 : 2));
        CHECK(unfold_branches(graph, tube.query, {}) == (has_third ? 2 : 1));
        const Ends after = ends_of(graph);
        CHECK(graph.nodes[tip].links.size() == 1);
        CHECK(after.ends == before.ends + 1);
        CHECK(after.junctions.size() == (has_third ? 2 : 1));
        for (const Vec3& p : after.junctions) CHECK(std::abs(p.z) < 0.7f * r);
        CHECK(after.seeds == before.seeds);
        for (const CurveGraph::Node& node : graph.nodes) {
            for (const std::uint32_t next : node.links)
                CHECK(tube.query.sees(node.position, graph.at(next)));
        }
    }
}

TEST_CASE("unfold_branches: a fold on the way round a cycle becomes a limb, and the cycle stays") {
    const Tube tube;
    const float r = tube.radius;
    CurveGraph graph;
    const std::uint32_t tip = graph.add({0, 0, 3 * r}, r);
    const std::uint32_t low = draw(graph, tip, {{-0.05f * r, 0, 0}, {-0.7f * r, 0, -2 * r}});
    graph.link(draw(graph, tip, {{0.05f * r, 0, 0}, {0.7f * r, 0, -2 * r}, {0, 0, -3 * r}}), low);
    draw(graph, low, {{-0.7f * r, 0, 0}});
    CHECK(unfold_branches(graph, tube.query, {}) == 1);
    const Ends after = ends_of(graph);
    CHECK(after.ends == 2);
    CHECK(after.junctions.size() == 2);
    CHECK(after.branches == 4);  // two of them round
}

TEST_CASE("unfold_branches: a tip on the surface, and a line shorter than its radius, end") {
    const Tube tube;
    const float r = tube.radius;
    CurveGraph graph;
    const std::uint32_t tip = graph.add({0, 0, 0.9999999f}, 0.0f);
    draw(graph, tip, {{0, 0, -3 * r}});
    draw(graph, tip, {{0.1f * r, 0, 0}, {0.8f * r, 0, -0.4f * r}});
    unfold_branches(graph, tube.query, {});
    CHECK(ends_of(graph).ends >= 2);

    CurveGraph line;
    const std::uint32_t start = line.add({0, 0, 0}, r);
    draw(line, draw(line, start, {{0, 0, 0.2f * r}}), {{0, 0, 0.4f * r}});
    CHECK(unfold_branches(line, tube.query, {}) == 0);
    CHECK(ends_of(line).ends == 2);
}

TEST_CASE("unfold_branches: an end that hooks back beside its own way is the end there") {
    const Tube tube;
    const float r = tube.radius;
    CurveGraph graph;
    const std::uint32_t tip = graph.add({0, 0, 3 * r}, r);
    draw(graph, tip, {{0, 0, -3 * r}});
    draw(graph, tip, {{0.1f * r, 0, 1.5f * r}});
    const Ends before = ends_of(graph);
    CHECK(unfold_branches(graph, tube.query, {}) == 1);
    const Ends after = ends_of(graph);
    CHECK(after.ends == 2);
    CHECK(after.junctions.empty());
    CHECK(graph.nodes[tip].links.size() == 1);
    CHECK(after.seeds == before.seeds);
}

TEST_CASE("unfold_branches: bends, short folds and cycles stay") {
    const Tube tube;
    const float r = tube.radius;
    CurveGraph bend;
    const std::uint32_t corner = bend.add({0.8f * r, 0, 0}, r);
    draw(bend, corner, {{-0.5f * r, 0, 3 * r}});
    draw(bend, corner, {{-0.5f * r, 0, -3 * r}});
    CHECK(unfold_branches(bend, tube.query, {}) == 0);

    CurveGraph fold;
    const std::uint32_t tip = fold.add({0, 0, 0.5f * r}, r);
    draw(fold, tip, {{0, 0, -3 * r}});
    draw(fold, tip, {{0.05f * r, 0, 0}, {0.8f * r, 0, 0}, {0.8f * r, 0, 3 * r}});
    CHECK(unfold_branches(fold, tube.query, {}) == 0);

    CurveGraph ring;
    const std::uint32_t start = ring.add({0, 0, 2 * r}, r);
    const std::uint32_t last = draw(ring, start, {{0, 0, -2 * r}, {0.1f * r, 0, -1.9f * r}});
    ring.link(draw(ring, last, {{0.1f * r, 0, 1.9f * r}}), start);
    unfold_branches(ring, tube.query, {});
    CHECK(ends_of(ring).ends == 0);
    CHECK(ring.branches().size() == 1);
}
