#include "zskel/mesh/parametric.h"

#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "support/extract.h"
#include "zskel/core/error.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/check.h"
#include "zskel/mesh/read_mesh.h"

using namespace zskel;

namespace {

Mesh parse(const std::string& text, MeshFormat format, double chord_error = 0.002) {
    return parse_mesh(std::as_bytes(std::span(text)), format, "a", {.chord_error = chord_error});
}

double volume_of(const Mesh& mesh) {
    double volume = 0.0;
    for (const Triangle& t : mesh.triangles) {
        volume +=
            glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) /
            6.0;
    }
    return volume;
}

// Every edge is there once in each direction.
bool is_watertight(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
    }
    return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
        const auto twin = sides.find({side.first.second, side.first.first});
        return side.second == 1 && twin != sides.end() && twin->second == 1;
    });
}

// A circle as a rational B-spline of degree 2; x, y, weight.
const std::vector<DVec3>& circle() {
    static const double w = std::sqrt(0.5);
    static const std::vector<DVec3> points = {{1, 0, 1},  {1, 1, w},  {0, 1, 1},
                                              {-1, 1, w}, {-1, 0, 1}, {-1, -1, w},
                                              {0, -1, 1}, {1, -1, w}, {1, 0, 1}};
    return points;
}

Nurbs torus(double large, double small) {
    Nurbs nurbs;
    nurbs.degree_u = nurbs.degree_v = 2;
    nurbs.knots_u = nurbs.knots_v = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    for (const DVec3& across : circle()) {
        auto& row = nurbs.points.emplace_back();
        for (const DVec3& along : circle()) {
            const double radius = large + small * across.x;
            row.emplace_back(radius * along.x, radius * along.y, small * across.y,
                             along.z * across.z);
        }
    }
    return nurbs;
}

}  // namespace

TEST_CASE("tessellate: a ball by superquadrics keeps within the chord error, and needs it") {
    for (const double chord : {0.01, 0.001}) {
        const Mesh ball = tessellate({superquadric_patches({.radii = DVec3(2.0)})}, chord, "ball");
        CHECK(is_watertight(ball));
        const double bound = chord * box_of(ball.positions).diagonal();
        double worst = 0.0;
        for (const Triangle& t : ball.triangles) {
            const DVec3 middle =
                (ball.positions[t.x] + ball.positions[t.y] + ball.positions[t.z]) / 3.0;
            worst = std::max(worst, 2.0 - glm::length(middle));
            for (int k = 0; k < 3; ++k) {
                CHECK(glm::length(ball.positions[t[k]]) == doctest::Approx(2.0));
                worst = std::max(
                    worst,
                    2.0 -
                        glm::length((ball.positions[t[k]] + ball.positions[t[(k + 1) % 3]]) * 0.5));
            }
        }
        CHECK(worst <= 1.4 * bound);  // a triangle's middle is farther than its edges'
        CHECK(worst >= 0.3 * bound);
        CHECK(volume_of(ball) > 0.0);
    }
}

TEST_CASE("superquadric_patches: round, square, turned; every point fits the formula") {
    const Superquadric shape{.radii = {1.0, 2.0, 0.5},
                             .exponent_1 = 0.4,
                             .exponent_2 = 1.7,
                             .center = {3, 0, 0},
                             .axis = {0, 0, 2},
                             .turn = std::numbers::pi / 2.0};
    const Mesh mesh = tessellate({superquadric_patches(shape)}, 0.01, "shape");
    CHECK(is_watertight(mesh));
    CHECK(volume_of(mesh) > 0.0);
    for (const DVec3& p : mesh.positions) {
        // Turned back: x was along -y.
        const DVec3 q(p.y, -(p.x - 3.0), p.z);
        const double round =
            std::pow(std::abs(q.x), 2.0 / 1.7) + std::pow(std::abs(q.y) / 2.0, 2.0 / 1.7);
        const double sum = std::pow(std::abs(q.z) / 0.5, 2.0 / 0.4) + std::pow(round, 1.7 / 0.4);
        CHECK(sum == doctest::Approx(1.0).epsilon(1e-6));
    }
}

TEST_CASE("nurbs_patches: a torus is exact at every vertex, and closed where it meets itself") {
    const Mesh mesh = tessellate({nurbs_patches(torus(2.0, 0.5))}, 0.002, "torus");
    CHECK(is_watertight(mesh));
    for (const DVec3& p : mesh.positions)
        CHECK(std::hypot(std::hypot(p.x, p.y) - 2.0, p.z) == doctest::Approx(0.5));
    CHECK(std::abs(volume_of(mesh)) ==
          doctest::Approx(2.0 * std::numbers::pi * std::numbers::pi * 2.0 * 0.25).epsilon(0.02));
    const std::size_t count = mesh.triangles.size();
    CHECK(tessellate({nurbs_patches(torus(2.0, 0.5))}, 0.0005, "torus").triangles.size() >
          2 * count);
}

TEST_CASE("bezier_patch: degree one is bilinear; corners are control points of any degree") {
    const ParametricPatch flat = bezier_patch({{{0, 0, 0}, {2, 0, 0}}, {{0, 1, 0}, {2, 1, 4}}});
    CHECK(glm::distance(flat.at(0.5, 0.5), DVec3(1, 0.5, 1)) < 1e-12);
    const ParametricPatch curved =
        bezier_patch({{{0, 0, 0}, {1, 5, 0}, {2, 0, 1}}, {{0, 1, 0}, {1, 1, 7}, {2, 1, 1}}});
    CHECK(curved.at(0, 0) == DVec3(0, 0, 0));
    CHECK(curved.at(1, 0) == DVec3(2, 0, 1));
    CHECK(curved.at(1, 1) == DVec3(2, 1, 1));
    CHECK(glm::distance(curved.at(0.5, 0), DVec3(1, 2.5, 0.25)) < 1e-12);
}

TEST_CASE("tessellate: what cannot be divided finely enough, or is not finite, is refused") {
    const PatchGroup group = superquadric_patches({});
    CHECK_THROWS_WITH_AS(tessellate({group}, 1e-9, "fine"), doctest::Contains("chord"), InputError);
    const ParametricPatch broken{[](double u, double) { return DVec3(1.0 / (u - 0.5), 0, 0); }};
    CHECK_THROWS_WITH_AS(tessellate({{broken}}, 0.01, "broken"), doctest::Contains("not finite"),
                         InputError);
    CHECK_THROWS_AS(tessellate({}, 0.01, "none"), InputError);
}

TEST_CASE("tessellate: patches are joined however far from the origin they are") {
    const auto offset = [](double x) {
        return PatchGroup{bezier_patch({{{x, 0, 0}, {x + 1, 0, 0}}, {{x, 1, 0}, {x + 1, 1, 0}}}),
                          bezier_patch({{{x, 1, 0}, {x + 1, 1, 0}}, {{x, 2, 0}, {x + 1, 2, 0}}})};
    };
    for (const double x : {0.0, 1e6, 1e12})
        CHECK(tessellate({offset(x)}, 0.01, "far").positions.size() == 45);
    CHECK_THROWS_WITH_AS(tessellate({{bezier_patch({{{0, 0, 0}, {1e300, 0, 0}},  //
                                                    {{0, 1, 0}, {1, 1, 0}}})}},
                                    0.01, "wide"),
                         doctest::Contains("too far"), InputError);
}

TEST_CASE("tessellate: as many spans as points, and one patch of many that never fits") {
    Nurbs nurbs;
    constexpr int kPoints = 100;
    for (int row = 0; row < kPoints; ++row) {
        nurbs.points.emplace_back();
        for (int column = 0; column < kPoints; ++column)
            nurbs.points.back().emplace_back(column, row, 0, 1);
    }
    for (int k = -1; k <= kPoints; ++k) nurbs.knots_u.push_back(std::clamp(k, 0, kPoints - 1));
    nurbs.knots_v = nurbs.knots_u;
    nurbs.degree_u = nurbs.degree_v = 1;
    CHECK(tessellate({nurbs_patches(nurbs)}, 0.01, "spans").triangles.size() == 99 * 99 * 32);

    PatchGroup group(300, bezier_patch({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {1, 1, 0}}}));
    group[7] = superquadric_patches({}).front();
    CHECK_THROWS_WITH_AS(tessellate({group}, 1e-9, "one of many"), doctest::Contains("chord"),
                         InputError);
}

TEST_CASE("our teapot: patches without gaps, and a skeleton with its handle's cycle and two ends") {
    const Mesh mesh = read_mesh(ZSKEL_MODELS "/teapot.bpt");
    CHECK(is_watertight(mesh));
    CHECK(volume_of(mesh) > 0.0);
    const ExtractResult result = test::extract(mesh);
    CHECK(result.check.failures.empty());
    CHECK(result.graph.edges.size() == result.graph.nodes.size());  // one part, one cycle
    const std::vector<std::uint32_t> degrees = node_degrees(result.graph);
    CHECK(std::count(degrees.begin(), degrees.end(), 1) == 2);
}

TEST_CASE("bpt: what is wrong is named, with its line") {
    const auto refused = [](const std::string& text, const char* piece) {
        INFO(text);
        CHECK_THROWS_WITH_AS(parse(text, MeshFormat::Bpt), doctest::Contains(piece), InputError);
    };
    const std::string patch = "1 1\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n";
    CHECK(parse("1\n" + patch, MeshFormat::Bpt, 0.1).positions.size() == 25);
    refused("x\n", "a:1: ");
    refused("0\n", "the number of patches is 0");
    refused("900\n" + patch, "the number of patches is 900");
    refused("1\n1 0\n", "a:2: a patch's second degree is 0");
    refused("1\n99 1\n", "first degree is 99");
    refused("1\n1 1\n0 0 0\n1 0 0\n0 1\n", "ends within a control point");
    refused("1\n1 1\n0 0 0\n1 nan 0\n0 1 0\n1 1 1\n", "a:4: ");
    refused("1\n" + patch + "7\n", "after the last of 1 patches");
    refused("2\n" + patch, "the file ends before");
}

TEST_CASE("surfaces by formula: each type is read; what is wrong is named, with its place") {
    const std::string ball = R"({"type": "superquadric", "radii": [1, 1, 1], "exponents": [1, 1]})";
    const Mesh two = parse(fmt::format(R"({{"surfaces": [{}, {{"type": "superquadric",
        "radii": [1, 1, 1], "exponents": [1, 1], "center": [5, 0, 0], "turn": 45,
        "axis": [1, 0, 0]}}]}})",
                                       ball),
                           MeshFormat::SurfaceJson, 0.01);
    CHECK(is_watertight(two));
    CHECK(box_of(two.positions).high.x == doctest::Approx(6.0).epsilon(0.01));
    const Mesh patch = parse(R"({"surfaces": [{"type": "bezier", "patches":
        [[[[0,0,0],[1,0,0]],[[0,1,0],[1,1,0]]]]}]})",
                             MeshFormat::SurfaceJson);
    CHECK(patch.positions.size() == 25);
    const Mesh spline = parse(R"({"surfaces": [{"type": "nurbs", "degrees": [1, 1],
        "knots": [[0,0,1,1], [0,0,1,1]],
        "points": [[[0,0,0,1],[1,0,0,1]],[[0,1,0,1],[1,1,0,2]]]}]})",
                              MeshFormat::SurfaceJson);
    CHECK(spline.positions.size() == 25);
    const auto refused = [](const std::string& text, const char* piece) {
        INFO(text);
        CHECK_THROWS_WITH_AS(parse(text, MeshFormat::SurfaceJson), doctest::Contains(piece),
                             InputError);
    };
    const auto refused_one = [&](const std::string& entry, const char* piece) {
        refused(fmt::format(R"({{"surfaces": [{}]}})", entry), piece);
    };
    refused("{", "a: no JSON");
    refused("{}", "has no member 'surfaces'");
    refused(R"({"surfaces": []})", "no face");
    refused_one(R"({"type": "blob"})", "surfaces[0]: type: '\"blob\"' is not bezier");
    refused_one(R"({"type": "superquadric", "radii": [1, 0, 1], "exponents": [1, 1]})",
                "surfaces[0]: radii[1]");
    refused_one(R"({"type": "superquadric", "radii": [1, 1, 1], "exponents": [1, 9]})",
                "exponents[1]");
    refused_one(R"({"type": "superquadric", "radii": [1, 1, 1], "exponents": [1, 1], "turn": 3})",
                "axis");
    refused_one(R"({"type": "bezier", "patches": [[[[0,0,0],[1,0,0]],[[0,1,0]]]]})",
                "patches[0][1]");
    refused_one(R"({"type": "nurbs", "degrees": [1, 1], "knots": [[0,0,1], [0,0,1,1]],
        "points": [[[0,0,0,1],[1,0,0,1]],[[0,1,0,1],[1,1,0,1]]]})",
                "knots[0]");
    refused_one(R"({"type": "nurbs", "degrees": [1, 1], "knots": [[0,0,1,0.5], [0,0,1,1]],
        "points": [[[0,0,0,1],[1,0,0,1]],[[0,1,0,1],[1,1,0,1]]]})",
                "knots[0][3]");
    refused_one(R"({"type": "nurbs", "degrees": [3, 1], "knots": [[0,0,1,1], [0,0,1,1]],
        "points": [[[0,0,0,1],[1,0,0,1]],[[0,1,0,1],[1,1,0,1]]]})",
                "degree 3 needs");
    refused_one(R"({"type": "nurbs", "degrees": [1, 1], "knots": [[0,0,1,1], [0,0,1,1]],
        "points": [[[0,0,0,1],[1,0,0,0]],[[0,1,0,1],[1,1,0,1]]]})",
                "points[0][1][3]");
}
