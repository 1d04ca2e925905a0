// Whole skeletons of solids with handles and cavities, and of what is no solid.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "support/cycles.h"
#include "support/extract.h"
#include "support/shapes.h"
#include "support/voxels.h"
#include "zskel/extract.h"
#include "zskel/mesh/solid.h"
#include "zskel/visibility/surface_query.h"

using namespace zskel;

namespace {

// One component, as many cycles as expected, all of a basis, and no edge through the surface.
void check_right(const ExtractResult& result, std::size_t cycles) {
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(result.statistics.expected_cycles == cycles);
    CHECK(graph_topology(result.graph).cycles == cycles);
    CHECK(test::cycles_of_a_basis(result) == cycles);
    const SurfaceQuery query(result.surface);
    std::size_t unfree = 0;
    for (const SkeletonGraph::Edge& e : result.graph.edges) {
        const auto place = [&](std::uint32_t n) {
            return result.surface.world_from_model.to_world(result.graph.nodes[n].position);
        };
        unfree += query.first_hit(place(e.source), place(e.target)) ? 1 : 0;
    }
    CHECK(unfree == 0);
}

bool has_warning(const ExtractResult& result, std::string_view part) {
    return std::any_of(
        result.warnings.begin(), result.warnings.end(),
        [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

ExtractOptions few_seeds(int seeds) {
    ExtractOptions options;
    options.newton.spread.min_seeds = options.newton.spread.max_seeds = seeds;
    return options;
}

}  // namespace

TEST_CASE("handles: plates, bars and suitcases have their cycles, and the right ones") {
    check_right(test::extract(test::plate_with_holes(4, 5, 2)), 20);
    check_right(test::extract(test::jungle_gym(2, 2)), 28);
    check_right(test::extract(test::slab_with_handles(3, 2)), 18);
}

TEST_CASE("handles: five hundred of them") {
    ExtractOptions options;
    options.newton.refine.sweeps = 0;
    check_right(test::extract(test::plate_with_holes(20, 25, 1), options), 500);
}

TEST_CASE("handles: more of them than seeds round them are found all the same") {
    check_right(test::extract(test::plate_with_holes(8, 8, 2), few_seeds(40)), 64);
    check_right(test::extract(test::jungle_gym(2, 3), few_seeds(30)), 28);
}

TEST_CASE("cavities: a ball in a ball has no cycle, a torus in a ball one") {
    const Mesh ball = test::sphere(0.5, 4);
    const ExtractResult hollow = test::extract(test::together(ball, test::sphere(0.2, 3)));
    CHECK(hollow.statistics.cavities == 1);
    check_right(hollow, 0);
    const ExtractResult ring = test::extract(test::together(ball, test::torus(0.25, 0.08)));
    CHECK(ring.statistics.cavities == 1);
    check_right(ring, 1);
}

TEST_CASE("cavities: two in a ball, and one off its middle") {
    const Mesh ball = test::sphere(0.5, 4);
    const Mesh small = test::sphere(0.12, 3);
    const ExtractResult two = test::extract(test::together(
        test::together(ball, test::moved(small, {0.2, 0, 0})), test::moved(small, {-0.2, 0.1, 0})));
    CHECK(two.statistics.cavities == 2);
    check_right(two, 0);
    const ExtractResult off =
        test::extract(test::together(ball, test::moved(small, {0, 0.3, 0.15})));
    check_right(off, 0);
}

TEST_CASE("cavities: a torus-shaped one in a torus's tube makes two cycles, a ball there one") {
    const Mesh torus = test::torus(0.35, 0.14);
    const ExtractResult two = test::extract(test::together(torus, test::torus(0.35, 0.06)));
    CHECK(two.statistics.cavities == 1);
    check_right(two, 2);
    const ExtractResult one =
        test::extract(test::together(torus, test::moved(test::sphere(0.06, 3), {0.35, 0, 0})));
    check_right(one, 1);
}

TEST_CASE("cavities: are told of") {
    const ExtractResult hollow =
        test::extract(test::together(test::sphere(0.5, 3), test::sphere(0.2, 3)));
    CHECK(has_warning(hollow, "1 cavity: the skeleton lies between the shells"));
    CHECK_FALSE(has_warning(test::extract(test::torus()), "cavity"));
}

TEST_CASE("handles: those below a size get no cycle, and are listed with size and place") {
    // Holes of 1 x 1 in a plate: 4 round, a radius of 0.64; the plate's bars are as thick.
    const Mesh plate = test::plate_with_holes(4, 2, 2);
    ExtractOptions options;
    options.newton.min_handle_model = 0.5;
    check_right(test::extract(plate, options), 8);
    options.newton.min_handle_model = 0.7;
    const ExtractResult none = test::extract(plate, options);
    CHECK(graph_topology(none.graph).cycles == 0);
    CHECK(none.statistics.expected_cycles == 0);
    REQUIRE(none.ignored_handles.size() == 8);
    CHECK(has_warning(none, "handles of a radius below 0.7 left without a cycle: 8"));
    for (const IgnoredHandle& handle : none.ignored_handles) {
        CHECK(handle.radius == doctest::Approx(4 / (2 * std::numbers::pi)));
        CHECK(handle.position.z >= 0.0);
        CHECK(handle.position.z <= 1.0);
    }
}

TEST_CASE("handles: small ones are ignored and the large one beside them is not") {
    // A frame with a wide opening; through one of its bars run four tunnels of 1 x 1.
    const Mesh frame = test::voxels({13, 13, 3}, 1, [](int x, int y, int) {
        if (x >= 3 && x < 10 && y >= 3 && y < 10) return false;
        return y != 1 || x % 3 != 2;
    });
    const ExtractResult all = test::extract(frame);
    check_right(all, 5);
    ExtractOptions options;
    options.newton.min_handle_model = 0.8;
    const ExtractResult large = test::extract(frame, options);
    CHECK(large.ignored_handles.size() == 4);
    const auto cycles = test::tree_cycles(large.graph);
    REQUIRE(cycles.size() == 1);
    DVec3 low(100.0);
    DVec3 high(-100.0);
    for (const std::uint32_t n : cycles[0]) {
        low = glm::min(low, large.graph.nodes[n].position);
        high = glm::max(high, large.graph.nodes[n].position);
    }
    CHECK(low.x < 3);
    CHECK(low.y < 3);
    CHECK(high.x > 10);
    CHECK(high.y > 10);
    for (const IgnoredHandle& handle : large.ignored_handles) {
        CHECK_FALSE(handle.is_cut);
        CHECK(handle.position.y == doctest::Approx(1.5).epsilon(0.4));
    }
}

TEST_CASE("handles: a thin bar across a ring is cut, and the ring keeps its cycle") {
    Mesh ring = test::voxels({9, 9, 3}, 2, [](int x, int y, int z) {
        const bool is_rim = x < 3 || x > 5 || y < 3 || y > 5;
        return is_rim || (y == 4 && z == 1);
    });
    for (DVec3& p : ring.positions) {
        if (p.x <= 3 || p.x >= 6 || p.y < 4 || p.y > 5 || p.z < 1 || p.z > 2) continue;
        p.y = 4.5 + (p.y - 4.5) * 0.2;
        p.z = 1.5 + (p.z - 1.5) * 0.2;
    }
    check_right(test::extract(ring), 2);
    ExtractOptions options;
    options.newton.min_handle_model = 0.3;
    const ExtractResult cut = test::extract(ring, options);
    REQUIRE(cut.ignored_handles.size() == 1);
    CHECK(cut.ignored_handles[0].is_cut);
    CHECK(glm::distance(cut.ignored_handles[0].position, DVec3(4.5, 4.5, 1.5)) < 1.6);
    REQUIRE(graph_topology(cut.graph).cycles == 1);
    const auto cycles = test::tree_cycles(cut.graph);
    for (const std::uint32_t n : cycles[0]) {
        const DVec3& p = cut.graph.nodes[n].position;
        CHECK(std::max(std::abs(p.x - 4.5), std::abs(p.y - 4.5)) > 1.5);
    }
}

namespace {

// A strip round the z axis that turns by `half_turns` on its way.
Mesh strip(int half_turns) {
    Mesh mesh;
    const std::uint32_t n = 48;
    const std::uint32_t across = 6;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        const double turn = std::numbers::pi * half_turns * i / n;
        for (std::uint32_t k = 0; k <= across; ++k) {
            const double t = 0.3 * (k / double(across) - 0.5);
            const double r = 0.5 + t * std::sin(turn);
            mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), t * std::cos(turn));
        }
    }
    const auto at = [&](std::uint32_t i, std::uint32_t k) {
        const bool is_flipped = i == n && half_turns % 2 == 1;
        return i % n * (across + 1) + (is_flipped ? across - k : k);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t k = 0; k < across; ++k) {
            test::add_triangle(mesh, at(i, k), at(i + 1, k), at(i + 1, k + 1));
            test::add_triangle(mesh, at(i, k), at(i + 1, k + 1), at(i, k + 1));
        }
    }
    return mesh;
}

// Two tetrahedra that share the vertices below `shared`.
Mesh bow_tie(std::uint32_t shared) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0.5, 0.8, 0}};
    for (const auto& t :
         {Triangle(0, 3, 2), Triangle(0, 2, 1), Triangle(0, 1, 3), Triangle(1, 2, 3)})
        test::add_triangle(mesh, t.x, t.y, t.z);
    Mesh other = mesh;
    for (DVec3& p : other.positions) p = DVec3(-p.x, -p.y, p.z);
    other.positions[0] = mesh.positions[0];
    if (shared < 2) other.positions[1] = {-0.2, -0.2, 1};
    return test::together(test::finer(mesh), test::finer(other));
}

constexpr const char* kOpen = "1 of 1 parts are not closed: the skeleton of each is in one piece";

}  // namespace

TEST_CASE("no solid: an open ring whose openings stay open is one piece, and says so") {
    ExtractOptions options;
    options.repair.has_caps = false;
    const ExtractResult result = test::extract(strip(0), options);
    CHECK(has_warning(result, kOpen));
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(graph_topology(result.graph).cycles == 0);
    CHECK(result.statistics.expected_cycles == 0);
}

TEST_CASE("no solid: a Moebius strip is one piece without a cycle, and says so") {
    const ExtractResult result = test::extract(strip(1));
    CHECK(has_warning(result, kOpen));
    CHECK(has_warning(result, "no consistent orientation exists"));
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(graph_topology(result.graph).cycles == 0);
}

TEST_CASE("no solid: two bodies that share an edge or a vertex part there") {
    const ExtractResult edge = test::extract(bow_tie(2));
    CHECK_FALSE(has_warning(edge, "not closed"));
    CHECK(has_warning(edge, "non-manifold edges parted"));
    CHECK(edge.statistics.solids == 2);
    CHECK(graph_topology(edge.graph).components == 2);
    CHECK(graph_topology(edge.graph).cycles == 0);
    const ExtractResult vertex = test::extract(bow_tie(1));
    CHECK_FALSE(has_warning(vertex, "not closed"));
    CHECK(vertex.statistics.solids == 2);
    CHECK(graph_topology(vertex.graph).components == 2);
}

TEST_CASE("handles: a surface that touches itself in a vertex is as if it did not") {
    // A bent chain of cubes whose ends meet in a corner.
    const std::set<std::tuple<int, int, int>> chain{{1, 1, 1}, {0, 1, 1}, {0, 1, 2}, {0, 1, 3},
                                                    {0, 2, 3}, {1, 2, 3}, {2, 2, 3}, {2, 2, 2}};
    const Mesh mesh = test::voxels({3, 3, 4}, 3, [&](int x, int y, int z) {
        return chain.count({x, y, z}) > 0;
    });
    const PreparedSurface prepared = prepare_surface(mesh);
    const std::vector<Solid> solids = split_solids(prepared);
    REQUIRE(solids.size() == 1);
    CHECK(solids[0].surface.positions.size() == prepared.surface.positions.size() + 1);
    const ExtractResult result = test::extract(mesh);
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(graph_topology(result.graph).cycles == 0);
    CHECK_FALSE(has_warning(result, "cycle"));
}
