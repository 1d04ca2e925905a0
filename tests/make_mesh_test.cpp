#include "zskel/mesh/make_mesh.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "zskel/core/error.h"

using namespace zskel;

namespace {

constexpr std::array<double, 12> kXyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1};
constexpr std::array<std::uint32_t, 12> kCorners{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

}  // namespace

TEST_CASE("make_mesh: vertices and triangles keep their numbers, every triangle is a face") {
    const Mesh mesh = make_mesh(kXyz.data(), 4, kCorners.data(), 4, "tetrahedron");
    CHECK(mesh.name == "tetrahedron");
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.positions[3] == DVec3(0, 0, 0.1));
    CHECK(mesh.triangles.size() == 4);
    CHECK(mesh.triangles[1] == Triangle(0, 1, 3));
    CHECK(mesh.face_of_triangle == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(mesh.face_count == 4);
    CHECK(mesh.hash == 0);
    CHECK(mesh.warnings.empty());
}

TEST_CASE("make_mesh: floats are taken as they are") {
    std::array<float, 12> xyz{};
    for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] = static_cast<float>(kXyz[i]);
    const Mesh mesh = make_mesh(xyz.data(), 4, kCorners.data(), 4);
    CHECK(mesh.positions[3].z == static_cast<double>(0.1f));
}

TEST_CASE("make_mesh: a number that is not finite is refused by its vertex") {
    for (const double bad :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        auto xyz = kXyz;
        xyz[7] = bad;
        CHECK_THROWS_WITH_AS(make_mesh(xyz.data(), 4, kCorners.data(), 4, "mine"),
                             doctest::Contains("mine: vertex 2 has y = "), InputError);
    }
}

TEST_CASE("make_mesh: a corner that is no vertex is refused by its triangle") {
    auto corners = kCorners;
    corners[11] = 4;
    CHECK_THROWS_WITH_AS(make_mesh(kXyz.data(), 4, corners.data(), 4, "mine"),
                         "mine: corner 2 of triangle 3 is vertex 4; there are 4, numbered from 0",
                         InputError);
}

TEST_CASE("make_mesh: no triangles, or more than can be numbered, are refused before any is read") {
    CHECK_THROWS_AS(make_mesh(kXyz.data(), 4, kCorners.data(), 0), InputError);
    const double* none = nullptr;
    CHECK_THROWS_AS(make_mesh(none, 0, nullptr, 0), InputError);
    CHECK_THROWS_AS(make_mesh(none, kNone, nullptr, 1), InputError);
}
