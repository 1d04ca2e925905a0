#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support/shapes.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/zip.h"

using namespace zskel;

namespace {

constexpr float kStep = 0.04f;

// New nodes from a node on, evenly along a line to each of the points; returns the last.
std::uint32_t draw(CurveGraph& graph, std::uint32_t from, std::initializer_list<Vec3> points) {
    for (const Vec3& to : points) {
        const Vec3 start = graph.at(from);
        const auto pieces = static_cast<int>(glm::distance(start, to) / kStep) + 1;
        for (int k = 1; k <= pieces; ++k) {
            const float share = static_cast<float>(k) / static_cast<float>(pieces);
            const std::uint32_t next = graph.add(glm::mix(start, to, share));
            graph.nodes[next].seeds = {next};
            graph.link(from, next);
            from = next;
        }
    }
    return from;
}

struct Ends {
    std::vector<Vec3> junctions;
    std::size_t ends = 0;
    std::size_t branches = 0;
    std::set<std::uint32_t> seeds;
};
Ends ends_of(const CurveGraph& graph) {
    Ends out;
    for (const CurveGraph::Node& node : graph.nodes) {
        if (node.is_removed) continue;
        if (node.links.size() > 2) out.junctions.push_back(node.position);
        out.ends += node.links.size() == 1 ? 1 : 0;
        out.seeds.insert(node.seeds.begin(), node.seeds.end());
    }
    out.branches = graph.branches().size();
    return out;
}

struct Tube {
    PreparedSurface prepared = prepare_surface(test::cylinder(0.25, 2.0, 24, 41));
    SurfaceQuery query{prepared.surface};
    float radius = query.nearest(Vec3(0.0f)).distance;
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
