#include "zskel/mesh/homology.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.h"
#include "support/voxels.h"
#include "zskel/mesh/linking.h"
#include "zskel/mesh/loops.h"
#include "zskel/skeleton/seeds.h"
#include "zskel/visibility/surface_query.h"

using namespace zskel;

namespace {

std::vector<Vec3> inner_of(const Surface& surface) {
    const SurfaceQuery query(surface);
    return inner_points(surface, vertex_thickness(surface, query), {});
}

// With handles of a radius below `min_radius_model` ignored.
HandleClasses handles_of(const Mesh& mesh, double min_radius_model = 0.0) {
    const PreparedSurface prepared = prepare_surface(mesh, WorldSize::Spread);
    const double scale = prepared.surface.world_from_model.scale;
    std::string why;
    auto handles =
        find_handles(prepared.surface, inner_of(prepared.surface), min_radius_model * scale, why);
    REQUIRE_MESSAGE(handles.has_value(), why);
    for (SmallHandle& handle : handles->ignored) handle.radius /= scale;
    return *std::move(handles);
}

// A polygon of n sides, as loops of vertices are.
std::vector<std::uint32_t> polygon(std::uint32_t first, std::uint32_t n) {
    std::vector<std::uint32_t> loop;
    for (std::uint32_t i = 0; i < n; ++i) loop.push_back(first + i);
    return loop;
}

}  // namespace

TEST_CASE("find_handles: a torus has one class, 1 round the hole and 0 round the tube") {
    const PreparedSurface prepared = prepare_surface(test::torus(0.35, 0.12, 32, 16));
    const Surface& surface = prepared.surface;
    std::string why;
    const auto handles = find_handles(surface, inner_of(surface), 0.0, why);
    REQUIRE(handles.has_value());
    CHECK(handles->genus == 1);
    const auto class_along = [&](const std::vector<std::uint32_t>& loop) {
        HandleClasses::Class sum = handles->zero();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
                if (surface.edges[e] == glm::uvec2(std::min(a, b), std::max(a, b)))
                    handles->add_edge(sum, e, a < b);
            }
        }
        return sum[0];
    };
    std::vector<std::uint32_t> round_hole;
    for (std::uint32_t i = 0; i < 32; ++i) round_hole.push_back(prepared.surface_vertex[i * 16]);
    std::vector<std::uint32_t> round_tube;
    for (std::uint32_t k = 0; k < 16; ++k) round_tube.push_back(prepared.surface_vertex[k]);
    CHECK(std::abs(class_along(round_hole)) == 1);
    CHECK(class_along(round_tube) == 0);
}

TEST_CASE("find_handles: an open surface has no answer, and says why") {
    Mesh open = test::cube();
    open.triangles.pop_back();
    const PreparedSurface prepared = prepare_surface(open);
    std::string why;
    CHECK_FALSE(find_handles(prepared.surface, inner_of(prepared.surface), 0.0, why).has_value());
    CHECK_FALSE(why.empty());
}

TEST_CASE("find_handles: as many classes as holes, bars and handles make, cavities included") {
    CHECK(handles_of(test::cube()).genus == 0);
    CHECK(handles_of(test::plate_with_holes(4, 5, 1)).genus == 20);
    CHECK(handles_of(test::jungle_gym(2, 2)).genus == 54 - 27 + 1);
    CHECK(handles_of(test::slab_with_handles(3, 1)).genus == 18);
    Mesh torus_in_torus = test::together(test::torus(0.35, 0.12), test::torus(0.35, 0.05));
    CHECK(handles_of(torus_in_torus).genus == 2);
}

TEST_CASE("find_handles: path sums tell ways round a hole apart, and nothing else") {
    const Mesh mesh = test::torus(0.35, 0.12, 48, 24);
    const PreparedSurface prepared = prepare_surface(mesh, WorldSize::Spread);
    std::string why;
    const auto handles = find_handles(prepared.surface, inner_of(prepared.surface), 0.0, why);
    REQUIRE(handles.has_value());
    const auto sum_of_arc = [&](double radius, double from, double to) {
        std::uint64_t sum = 0;
        const auto at = [&](int i) {
            const double angle = from + (to - from) * i / 40.0;
            const double r = i == 0 || i == 40 ? 0.35 : radius;
            return prepared.surface.world_from_model.to_world(
                DVec3(r * std::cos(angle), r * std::sin(angle), 0));
        };
        for (int i = 0; i < 40; ++i) sum += handles->segment_sum(at(i), at(i + 1));
        return sum;
    };
    constexpr double kPi = std::numbers::pi;
    CHECK(sum_of_arc(0.3, 0, kPi) == sum_of_arc(0.4, 0, kPi));
    CHECK(sum_of_arc(0.3, 0, kPi) != sum_of_arc(0.3, 0, -kPi));
    CHECK(sum_of_arc(0.3, 0, kPi) - sum_of_arc(0.4, 0, -kPi) == sum_of_arc(0.3, 0, 2 * kPi));
    CHECK(sum_of_arc(0.3, 0, 2 * kPi) == 0 - sum_of_arc(0.3, 0, -2 * kPi));
}

TEST_CASE("find_handles: small handles are told by hole or girth, with size and place") {
    // A ring with a thin bar across: cutting the bar leaves the ring's own cycle.
    const auto ring = [](double bar) {
        Mesh mesh = test::voxels({9, 9, 3}, 1, [](int x, int y, int z) {
            const bool is_rim = x < 3 || x > 5 || y < 3 || y > 5;
            return is_rim || (y == 4 && z == 1);
        });
        for (DVec3& p : mesh.positions) {
            if (p.x < 3 || p.x > 6) continue;
            if (p.y == 4 || p.y == 5) p.y = 4.5 + (p.y - 4.5) * bar;
            if (p.z == 1 || p.z == 2) p.z = 1.5 + (p.z - 1.5) * bar;
        }
        return mesh;
    };
    CHECK(handles_of(ring(1.0)).ignored.empty());
    const HandleClasses cut = handles_of(ring(0.2), 0.2);
    CHECK(cut.genus == 2);
    REQUIRE(cut.ignored.size() == 1);
    CHECK(cut.ignored[0].is_cut);
    CHECK(cut.ignored[0].radius == doctest::Approx(0.8 / (2 * std::numbers::pi)).epsilon(0.3));
    CHECK(cut.cycles() == 1);

    const Mesh plate = test::plate_with_holes(3, 1, 2);
    CHECK(handles_of(plate, 0.5).ignored.empty());
    const HandleClasses filled = handles_of(plate, 0.7);
    REQUIRE(filled.ignored.size() == 3);
    for (const SmallHandle& handle : filled.ignored) {
        CHECK(handle.radius == doctest::Approx(4 / (2 * std::numbers::pi)));
    }
    CHECK(filled.cycles() == 0);
}

TEST_CASE("LoopPassages: linked circles link once, others not at all") {
    std::vector<Vec3> points;
    const std::uint32_t n = 40;
    const auto add_circle = [&](const Vec3& center, const Vec3& u, const Vec3& v) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto angle = static_cast<float>(2 * std::numbers::pi * i / n);
            points.push_back(center + u * std::cos(angle) + v * std::sin(angle));
        }
    };
    add_circle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_circle({1, 0, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    add_circle({4, 0, 0}, {0.5, 0, 0}, {0, 0.3, 0.5});
    std::vector<std::vector<std::uint32_t>> loops;
    for (std::uint32_t k = 0; k < 3; ++k) loops.push_back(polygon(k * n, n));
    const auto links = LoopPassages(loops, points).link(points);
    CHECK(std::abs(links[0][1]) == 1);
    CHECK(links[0][1] == links[1][0]);
    for (const auto& [i, j] : {std::pair(0, 2), std::pair(1, 2), std::pair(2, 0)})
        CHECK(links[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] == 0);
}

TEST_CASE("IntegerBasis: parts of integer bases, and what only spans a sublattice") {
    using Vectors = std::vector<IntegerBasis::Vector>;
    const auto takes_all = [](const Vectors& vectors) {
        IntegerBasis basis(vectors[0].size());
        return std::all_of(vectors.begin(), vectors.end(),
                           [&](const auto& vector) { return basis.extend(vector); });
    };
    CHECK(takes_all({{1, 0, 0}}));
    CHECK(takes_all({{2, 3}}));
    CHECK(takes_all({{2, 3}, {1, 1}}));
    CHECK(takes_all({{6, 10, 15}, {1, 1, 1}, {-2, -1, 0}}));
    CHECK_FALSE(takes_all({{2, 0}}));
    CHECK_FALSE(takes_all({{0, 0}}));
    CHECK_FALSE(takes_all({{1, 1}, {1, -1}}));
    CHECK_FALSE(takes_all({{1, 2}, {2, 4}}));
    CHECK_FALSE(takes_all({{6, 10, 15}, {1, 1, 1}, {0, 2, 4}}));
}

TEST_CASE("choose_basis: the last first, and as many as are asked for") {
    CHECK(choose_basis({{1, 0}, {2, 0}, {0, 1}, {1, 1}}, 2) == std::vector<std::uint32_t>{3, 2});
    CHECK(choose_basis({{1, 0}, {2, 0}, {3, 0}}, 2) == std::vector<std::uint32_t>{0});
}
