#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support/shapes.h"
#include "support/voxels.h"
#include "zskel/mesh/vertex_graph.h"
#include "zskel/skeleton/coverage.h"
#include "zskel/skeleton/girth.h"
#include "zskel/skeleton/limbs.h"
#include "zskel/skeleton/patches.h"
#include "zskel/skeleton/section.h"

using namespace zskel;

namespace {

struct Shape {
    explicit Shape(const Mesh& mesh)
        : surface(prepare_surface(mesh, WorldSize::Spread).surface), query(surface) {}
    Vec3 at(double x, double y, double z) const {
        return surface.world_from_model.to_world(DVec3(x, y, z));
    }
    double model(float world) const {
        return surface.world_from_model.length_to_model(static_cast<double>(world));
    }
    Surface surface;
    SurfaceQuery query;
};

}  // namespace

TEST_CASE("the girth is the radius at a ball's centre and 1.15 of it on a tube's axis") {
    const Shape ball(test::sphere(0.5));
    CHECK(ball.model(girths_at(ball.query, std::array{ball.at(0, 0, 0)})[0]) ==
          doctest::Approx(0.5).epsilon(0.01));
    const Shape tube(test::cylinder(0.1, 2.0));
    CHECK(tube.model(girths_at(tube.query, std::array{tube.at(0, 0, 0)})[0]) ==
          doctest::Approx(0.1 / std::sin(std::acos(0.5))).epsilon(0.04));
}

TEST_CASE(
    "the depth under a sphere is the median half chord into the cone, and infinite without a "
    "normal") {
    const Shape ball(test::sphere(0.5));
    const std::array inside{ball.at(0, 0, 0.499), ball.at(0, 0, 0.499)};
    const std::vector<float> depths =
        depths_under(ball.query, inside, std::array{Vec3(0, 0, 1), Vec3(0.0f)});
    CHECK(ball.model(depths[0]) == doctest::Approx(0.5 * 0.85).epsilon(0.02));
    CHECK(std::isinf(depths[1]));
}

TEST_CASE("a step to the section's centre lands on a tube's axis, from either side") {
    const Shape tube(test::cylinder(0.1, 2.0));
    const auto off = static_cast<float>(0.04 * tube.surface.world_from_model.scale);
    Vec3 point = tube.at(0, 0, 0) + Vec3(off, 0.0f, 0.0f);
    for (int i = 0; i < 4; ++i) point += step_to_section_centre(tube.query, point, Vec3(0, 0, 1));
    CHECK(tube.model(glm::distance(point, tube.at(0, 0, 0))) < 0.002);
}

TEST_CASE("half a section's width is half the chord along the nearest wall") {
    const Shape tube(test::cylinder(0.1, 2.0));
    CHECK(tube.model(section_half_width(tube.query, tube.at(0.05, 0, 0), Vec3(0, 0, 1))) ==
          doctest::Approx(0.1 * std::sqrt(0.75)).epsilon(0.003));
}

TEST_CASE("a ball covers only the places that its centre sees") {
    const Shape two(test::together(test::sphere(0.5), test::moved(test::sphere(0.5), {1.2, 0, 0})));
    const Vec3 here = two.at(0.5, 0, 0);
    const Vec3 there = two.at(0.7, 0, 0);
    Coverage coverage(two.query, {here, there}, {two.at(0.49, 0, 0), two.at(0.71, 0, 0)});
    const std::array centre{two.at(0, 0, 0), two.at(0, 0, 0)};
    const auto radius = static_cast<float>(0.4 * two.surface.world_from_model.scale);
    coverage.add(centre, radius, radius);
    CHECK(two.model(coverage.beyond(0)) == doctest::Approx(0.1).epsilon(0.01));
    CHECK(std::isinf(coverage.beyond(1)));
}

TEST_CASE("the vertices of every node are one patch, by the nearest node of their limb") {
    const Shape tube(test::cylinder(0.1, 2.0));
    std::vector<Vec3> nodes;
    NodeLinks links;
    for (std::uint32_t n = 0; n < 10; ++n) {
        nodes.push_back(tube.at(0, 0, -0.9 + 0.2 * n));
        links.emplace_back();
        if (n == 0) continue;
        links[n].push_back(n - 1);
        links[n - 1].push_back(n);
    }
    const std::vector<std::uint32_t> near(tube.surface.positions.size(), 4);
    const std::vector<std::uint32_t> patches = assign_patches(tube.surface, nodes, links, near);
    const VertexGraph graph(tube.surface.positions.size(), tube.surface.edges);
    std::vector<bool> seen(patches.size(), false);
    std::set<std::uint32_t> met;
    for (std::uint32_t first = 0; first < patches.size(); ++first) {
        if (seen[first]) continue;
        CHECK(met.insert(patches[first]).second);
        std::vector<std::uint32_t> patch{first};
        seen[first] = true;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            for (const VertexGraph::Link& link : graph.of(patch[i])) {
                if (seen[link.vertex] || patches[link.vertex] != patches[first]) continue;
                seen[link.vertex] = true;
                patch.push_back(link.vertex);
            }
        }
    }
    CHECK(met.size() == 10);
}

TEST_CASE("a limb goes straight where the connections along its surface lead out and back") {
    // An arm on a cube, and clusters along its axis; from 4 the surface leads by 3 to 2, beside 4.
    const Shape shape(test::voxels(
        {5, 5, 20}, 2, [](int x, int y, int z) { return z < 5 || (x == 2 && y == 2); }));
    const auto on_axis = [&](double aside, double z) { return shape.at(2.5 + aside, 2.5, z); };
    Clusters clusters;
    clusters.centers = {on_axis(0, 2.5),    on_axis(0, 6),       on_axis(0.05, 8.1),
                        on_axis(0.1, 11.0), on_axis(-0.05, 8.2), on_axis(0, 19.3)};
    clusters.of_point = {0, 1, 2, 3, 4, 5};
    const std::vector<float> girths = girths_at(shape.query, clusters.centers);
    ClusterNetwork network;
    std::vector<glm::uvec2> links;
    for (std::uint32_t c = 0; c + 1 < clusters.centers.size(); ++c) {
        Connection connection;
        connection.a = c;
        connection.b = c + 1;
        connection.path = {clusters.centers[c], clusters.centers[c + 1]};
        connection.length = glm::distance(connection.path[0], connection.path[1]);
        network.spanning.push_back(c);
        network.connections.push_back(connection);
        links.emplace_back(c, c + 1);
    }
    SeedSpread spread;
    std::vector<SettledSeed> settled;
    for (const Vec3& centre : clusters.centers) {
        const auto nearest = std::ranges::min_element(
            shape.surface.positions, {}, [&](const Vec3& p) { return glm::distance(p, centre); });
        spread.vertices.push_back(
            static_cast<std::uint32_t>(nearest - shape.surface.positions.begin()));
        settled.emplace_back().position = centre;
    }
    spread.vertices.back() = static_cast<std::uint32_t>(
        std::ranges::max_element(shape.surface.positions, {}, [](const Vec3& p) { return p.z; }) -
        shape.surface.positions.begin());
    std::vector<Vec3> inner;
    for (const Vec3& p : shape.surface.positions) {
        const auto nearest = std::ranges::min_element(
            clusters.centers, {}, [&](const Vec3& c) { return glm::distance(p, c); });
        spread.seed_of.push_back(static_cast<std::uint32_t>(nearest - clusters.centers.begin()));
        inner.push_back(glm::mix(p, *nearest, 0.01f));
    }
    const ClusterContext context{shape.surface, shape.query, spread,   settled, inner,
                                 links,         {},          clusters, girths,  true};
    const Limbs limbs = grow_limbs(context, network, {});
    std::set<std::pair<std::uint32_t, std::uint32_t>> joined;
    for (const Connection& c : limbs.connections) joined.emplace(c.a, c.b);
    CHECK(joined ==
          std::set<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {1, 2}, {2, 4}, {4, 5}});
    CHECK(limbs.home[3] != 3);
}
