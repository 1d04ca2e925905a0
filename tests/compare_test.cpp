#include "zskel/compare.h"

#include <doctest/doctest.h>

#include "support/shapes.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"

using namespace zskel;

namespace {

SkeletonGraph line(const DVec3& from, const DVec3& to) {
    SkeletonGraph graph;
    graph.nodes = {{from, 0.1, 0}, {to, 0.1, 0}};
    graph.edges = {{0, 1}};
    return graph;
}

// A source whose distances are off by a known factor.
class Stretched : public VisibilitySource {
  public:
    Stretched(VisibilitySource& truth, float factor)
        : VisibilitySource(truth.solid(), truth.directions()), truth_(truth), factor_(factor) {}
    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        truth_.render(eyes, maps);
        for (float& d : maps.distance) d *= factor_;
    }

  private:
    VisibilitySource& truth_;
    float factor_;
};

}  // namespace

TEST_CASE("mean_distance: parallel lines, a line and itself, a point and a line") {
    CHECK(mean_distance(line({0, 0, 0}, {1, 0, 0}), line({0, 0.25, 0}, {1, 0.25, 0})) ==
          doctest::Approx(0.25));
    CHECK(mean_distance(line({0, 0, 0}, {1, 0, 0}), line({0, 0, 0}, {1, 0, 0})) == 0.0);
    SkeletonGraph point;
    point.nodes = {{{0, 0, 3}, 0.1, 0}};
    // One way 3, the other the mean of sqrt(9 + x^2) over [0, 1]: 3.0547.
    CHECK(mean_distance(point, line({0, 0, 0}, {1, 0, 0})) ==
          doctest::Approx(0.5 * (3.0 + 3.0547)).epsilon(1e-4));
}

TEST_CASE("compare_sources: finds a stretched map, and finds nothing in an equal one") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const auto truth = make_ray_source(prepared.surface, cube_directions(16));
    const std::vector<Vec3> eyes = comparison_eyes(prepared.surface, *truth, 9, {});
    CHECK(eyes.size() == 9);
    Stretched off(*truth, 1.01f);
    const SourceComparison c = compare_sources(off, *truth, eyes);
    CHECK(c.all.median == doctest::Approx(0.01).epsilon(0.01));
    CHECK(c.id_agreement_all == 1.0);
    CHECK_FALSE(is_within(c, {}));
    const SourceComparison same = compare_sources(*truth, *truth, eyes);
    CHECK(same.all.worst == 0.0);
    CHECK(same.force_error_worst == 0.0);
    CHECK(is_within(same, {}));
}

TEST_CASE("compare_sources: maps of different sizes are a usage error") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const auto a = make_ray_source(prepared.surface, cube_directions(8));
    const auto b = make_ray_source(prepared.surface, cube_directions(16));
    const Vec3 eye(0.0f);
    CHECK_THROWS_AS(compare_sources(*a, *b, std::span(&eye, 1)), UsageError);
}

TEST_CASE("compare_skeletons: counts the seeds that part, and names them") {
    ExtractResult a;
    a.surface = prepare_surface(test::cube()).surface;
    a.graph = line({0, 0, 0}, {0.1, 0, 0});
    for (std::uint32_t v = 0; v < 10; ++v) {
        SeedReport seed;
        seed.vertex = v;
        a.seeds.push_back(seed);
    }
    ExtractResult b = a;
    CHECK(is_within(compare_skeletons(a, b, 0.005), {}));
    b.seeds[3].end.x = 0.006;
    const SkeletonComparison c = compare_skeletons(a, b, 0.005);
    CHECK(c.parted == std::vector<std::uint32_t>{3});
    CHECK_FALSE(is_within(c, {}));  // one in ten is more than 5 %
}
