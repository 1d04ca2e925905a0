#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "support/drawn_graph.h"
#include "support/voxels.h"
#include "zskel/skeleton/zip.h"

using namespace zskel;
using test::draw;
using test::Ends;
using test::ends_of;
using test::Tube;

namespace {

// Eight voxels about a hole, and a bar from the middle of the right side.
struct RingWithBar {
    PreparedSurface prepared = prepare_surface(test::voxels(
        {24, 3, 1}, 3, [](int x, int y, int) { return x < 3 ? x != 1 || y != 1 : y == 1; }));
    SurfaceQuery query{prepared.surface};

    Vec3 at(double x, double y) const {
        return Vec3(prepared.surface.world_from_model.to_world(DVec3(x, y, 0.5)));
    }
};

}  // namespace

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

TEST_CASE("zip_branches: the way round a hole is not taken for the short one beside it") {
    const RingWithBar solid;
    const auto at = [&](double x, double y) { return solid.at(x, y); };
    CurveGraph graph;
    const std::uint32_t first = graph.add(at(2.5, 1.45));
    const std::uint32_t second =
        draw(graph, first, {at(2.5, 0.5), at(0.5, 0.5), at(0.5, 2.5), at(2.5, 2.5), at(2.5, 1.55)});
    draw(graph, first, {at(2.2, 1.4)});
    draw(graph, second, {at(2.2, 1.6)});
    const std::uint32_t meeting = draw(graph, second, {at(4, 1.55), at(16, 1.5)});
    draw(graph, meeting, {at(23, 1.5)});
    graph.link(draw(graph, first, {at(2.6, 1.5), at(4, 1.45), at(15.5, 1.45)}), meeting);

    // The graph has one cycle: its turns about the hole are what one edge outside a tree closes.
    const auto turns = [&] {
        const Vec3 hole = at(1.5, 1.5);
        const auto angle = [&](std::uint32_t a, std::uint32_t b) {
            const Vec3 u = graph.at(a) - hole;
            const Vec3 v = graph.at(b) - hole;
            return std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
        };
        std::map<std::uint32_t, float> way{{meeting, 0.0f}};
        std::vector<std::uint32_t> queue{meeting};
        float most = 0.0f;
        for (std::size_t i = 0; i < queue.size(); ++i) {
            for (const std::uint32_t next : graph.nodes[queue[i]].links) {
                const float there = way.at(queue[i]) + angle(queue[i], next);
                const auto [known, is_new] = way.emplace(next, there);
                if (is_new) queue.push_back(next);
                most = std::max(most, std::abs(known->second - there));
            }
        }
        return most / (2.0f * std::numbers::pi_v<float>);
    };
    REQUIRE(turns() == doctest::Approx(1.0f));
    zip_branches(graph, solid.query, {});
    CHECK(turns() == doctest::Approx(1.0f));
}

TEST_CASE("zip_branches: a ring takes nothing off what is longer") {
    const RingWithBar solid;
    const auto at = [&](double x, double y) { return solid.at(x, y); };
    CurveGraph graph;
    const std::uint32_t joint = graph.add(at(2.5, 1.5));
    graph.link(
        draw(graph, joint, {at(2.5, 0.5), at(0.5, 0.5), at(0.5, 2.5), at(2.5, 2.5), at(2.5, 1.6)}),
        joint);
    std::uint32_t last = joint;  // closer together than the ring's
    for (double x = 2.6; x < 23.0; x += 0.1) {
        const std::uint32_t next = graph.add(at(x, 1.5));
        graph.link(last, next);
        last = next;
    }
    CHECK(zip_branches(graph, solid.query, {}) == 0);
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
