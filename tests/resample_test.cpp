#include "zskel/skeleton/resample.h"

#include <doctest/doctest.h>

#include <array>

#include "support/drawn_graph.h"
#include "support/voxels.h"

using namespace zskel;
using test::Tube;

TEST_CASE("resample_branches: a ring that has shrunk to a place is a ring still") {
    const Tube tube;
    CurveGraph graph;
    for (std::uint32_t n = 0; n < 4; ++n) {
        graph.add(Vec3(0.0f));
        if (n > 0) graph.link(n - 1, n);
    }
    graph.link(3, 0);
    resample_branches(graph, {}, tube.query, {}, Spacing::ByRadius);
    std::size_t nodes = 0;
    for (const CurveGraph::Node& node : graph.nodes) {
        if (node.is_removed) continue;
        ++nodes;
        CHECK(node.links.size() == 2);
    }
    CHECK(nodes == 3);
}

TEST_CASE("resample_branches: a doubled node at a corner does not hide the corner") {
    // From one arm of an L to the other, by its corner.
    const PreparedSurface prepared = prepare_surface(
        test::voxels({3, 3, 1}, 2, [](int x, int y, int) { return x == 0 || y == 0; }));
    const SurfaceQuery query(prepared.surface);
    const auto at = [&](double x, double y) {
        return Vec3(prepared.surface.world_from_model.to_world(DVec3(x, y, 0.5)));
    };
    RefineOptions options;
    options.min_spacing_world = options.max_spacing_world = 2.0;  // across all
    CurveGraph graph;
    const std::array line{at(2.5, 0.5), at(2.5, 0.5), at(0.5, 0.5), at(0.5, 2.5)};
    for (const Vec3& p : line) {
        const std::uint32_t n = graph.add(p);
        if (n > 0) graph.link(n - 1, n);
    }
    resample_branches(graph, {}, query, options, Spacing::ByRadius);
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        for (const std::uint32_t other : graph.nodes[n].links)
            CHECK(query.sees(graph.at(n), graph.at(other)));
    }
}
