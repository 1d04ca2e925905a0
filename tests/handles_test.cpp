// Whole skeletons of solids with handles and cavities, and of what is no solid.
#include <doctest/doctest.h>

#include <cmath>

#include "support/cycles.h"
#include "support/shapes.h"
#include "support/voxels.h"
#include "zskel/extract.h"
#include "zskel/visibility/surface_query.h"

using namespace zskel;

namespace {

ExtractResult extract(const Mesh& mesh, const ExtractOptions& options = {}) {
    BackendOptions backend_options;
    backend_options.kind = BackendKind::Ray;
    backend_options.face_px = 8;
    return extract_skeleton(mesh, options, *open_backend(backend_options));
}

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
    options.newton.spread.max_seeds = seeds;
    return options;
}

}  // namespace

TEST_CASE("handles: plates, bars and suitcases have their cycles, and the right ones") {
    check_right(extract(test::plate_with_holes(4, 5, 2)), 20);
    check_right(extract(test::jungle_gym(2, 2)), 28);
    check_right(extract(test::slab_with_handles(3, 2)), 18);
}

TEST_CASE("handles: more of them than seeds round them are found all the same") {
    check_right(extract(test::plate_with_holes(8, 8, 2), few_seeds(40)), 64);
    check_right(extract(test::jungle_gym(2, 3), few_seeds(30)), 28);
}

TEST_CASE("cavities: a ball in a ball has no cycle, a torus in a ball one") {
    const Mesh ball = test::sphere(0.5, 4);
    const ExtractResult hollow = extract(test::together(ball, test::sphere(0.2, 3)));
    CHECK(hollow.statistics.cavities == 1);
    check_right(hollow, 0);
    const ExtractResult ring = extract(test::together(ball, test::torus(0.25, 0.08)));
    CHECK(ring.statistics.cavities == 1);
    check_right(ring, 1);
}

TEST_CASE("cavities: two in a ball, and one off its middle") {
    const Mesh ball = test::sphere(0.5, 4);
    const Mesh small = test::sphere(0.12, 3);
    const ExtractResult two = extract(test::together(
        test::together(ball, test::moved(small, {0.2, 0, 0})), test::moved(small, {-0.2, 0.1, 0})));
    CHECK(two.statistics.cavities == 2);
    check_right(two, 0);
    const ExtractResult off = extract(test::together(ball, test::moved(small, {0, 0.3, 0.15})));
    check_right(off, 0);
}

TEST_CASE("cavities: a torus-shaped one in a torus's tube makes two cycles, a ball there one") {
    const Mesh torus = test::torus(0.35, 0.14);
    const ExtractResult two = extract(test::together(torus, test::torus(0.35, 0.06)));
    CHECK(two.statistics.cavities == 1);
    check_right(two, 2);
    const ExtractResult one =
        extract(test::together(torus, test::moved(test::sphere(0.06, 3), {0.35, 0, 0})));
    check_right(one, 1);
}
