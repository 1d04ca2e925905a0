#include "zskel/mesh/surface.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/shapes.h"
#include "zskel/core/error.h"
#include "zskel/mesh/solid.h"
#include "zskel/mesh/winding.h"
#include "zskel/visibility/surface_query.h"

using namespace zskel;

namespace {

double volume_of(const Surface& surface) {
    double volume = 0.0;
    for (const Triangle& t : surface.triangles) {
        volume +=
            glm::dot(DVec3(surface.positions[t.x]),
                     glm::cross(DVec3(surface.positions[t.y]), DVec3(surface.positions[t.z])));
    }
    return volume / 6.0;
}

bool has_repair(const PreparedSurface& prepared, std::string_view piece) {
    return std::any_of(prepared.repairs.begin(), prepared.repairs.end(), [&](const Repair& repair) {
        return repair.what.find(piece) != std::string::npos;
    });
}

}  // namespace

TEST_CASE("prepare_surface: a proper solid needs no repair and fills the unit cube") {
    const PreparedSurface prepared =
        prepare_surface(test::moved(test::cube(), {7, -3, 1e6}, 250.0));
    CHECK(prepared.repairs.empty());
    CHECK(prepared.component_count == 1);
    CHECK(volume_of(prepared.surface) == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(prepared.surface.edges.size() == 18);
    const DVec3 back = prepared.surface.world_from_model.to_model({0.5f, 0.5f, 0.5f});
    CHECK(glm::distance(back, DVec3(7 + 125, -3 + 125, 1e6 + 125)) < 1e-6);
}

TEST_CASE("prepare_surface: the same at scales from 1e-9 to 1e9") {
    for (const double scale : {1e-9, 1.0, 1e9}) {
        const PreparedSurface prepared =
            prepare_surface(test::moved(test::torus(), DVec3(0), scale));
        CHECK(prepared.surface.world_from_model.scale == doctest::Approx(1.0 / (0.94 * scale)));
        CHECK(prepared.repairs.empty());
    }
}

TEST_CASE("prepare_surface: a soup is welded, and input vertices keep their numbers") {
    const Mesh solid = test::torus();
    Mesh soup;
    for (const Triangle& t : solid.triangles) {
        for (int k = 0; k < 3; ++k) soup.positions.push_back(solid.positions[t[k]]);
        const auto n = static_cast<std::uint32_t>(soup.positions.size());
        test::add_triangle(soup, n - 3, n - 2, n - 1);
    }
    const PreparedSurface prepared = prepare_surface(soup);
    CHECK(prepared.surface.positions.size() == solid.positions.size());
    CHECK(prepared.component_closed.at(0));
    CHECK(has_repair(prepared, "welded"));
    CHECK(prepared.surface_vertex.size() == soup.positions.size());
}

TEST_CASE(
    "prepare_surface: inside out, half flipped and doubled meshes come out outward and single") {
    const Mesh solid = test::torus();
    Mesh half = solid;
    for (std::size_t t = 0; t < half.triangles.size(); t += 3)
        std::swap(half.triangles[t].y, half.triangles[t].z);
    const double truth = volume_of(prepare_surface(solid).surface);
    for (const Mesh& mesh : {test::turned_inside_out(solid), half, test::together(solid, solid)}) {
        const PreparedSurface prepared = prepare_surface(mesh);
        CHECK(volume_of(prepared.surface) == doctest::Approx(truth).epsilon(1e-6));
        CHECK(prepared.surface.triangles.size() == solid.triangles.size());
        CHECK(prepared.repairs.size() >= 1);
    }
}

TEST_CASE("prepare_surface: a fin does not say which of its neighbours is turned") {
    const Mesh cube = test::cube();
    const Triangle& root = cube.triangles[0];
    for (std::size_t flipped = 0; flipped < cube.triangles.size(); ++flipped) {
        Mesh mesh = cube;
        mesh.positions.emplace_back(0.5, -3, -3);
        test::add_triangle(mesh, root.x, root.y,
                           static_cast<std::uint32_t>(mesh.positions.size() - 1));
        std::swap(mesh.triangles[flipped].y, mesh.triangles[flipped].z);
        const PreparedSurface prepared = prepare_surface(mesh);
        INFO("flipped " << flipped);
        CHECK(has_repair(prepared, "non-manifold"));
        CHECK_FALSE(has_repair(prepared, "no consistent orientation"));
        // The area vectors of a closed surface add up to nothing when its faces agree.
        const Surface& surface = prepared.surface;
        DVec3 sum(0.0);
        for (std::size_t t = 0; t < cube.triangles.size(); ++t) {
            const Triangle& corners = surface.triangles[t];
            const DVec3 a(surface.positions[corners.x]);
            sum += glm::cross(DVec3(surface.positions[corners.y]) - a,
                              DVec3(surface.positions[corners.z]) - a);
        }
        CHECK(glm::length(sum) < 1e-6);
    }
}

TEST_CASE("prepare_surface: unreferenced vertices have no place") {
    Mesh mesh = test::cube();
    mesh.positions.emplace_back(100, 100, 100);
    const PreparedSurface prepared = prepare_surface(mesh);
    CHECK(prepared.surface_vertex.back() == kNone);
    CHECK(prepared.surface.world_from_model.scale == doctest::Approx(1.0));
}

TEST_CASE("prepare_surface: a mesh without area is an input error that names it") {
    Mesh line;
    line.name = "line.obj";
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    test::add_triangle(line, 0, 1, 2);
    CHECK_THROWS_WITH_AS(prepare_surface(line), doctest::Contains("line.obj"), InputError);
    Mesh point = line;
    for (DVec3& p : point.positions) p = DVec3(0.0);
    CHECK_THROWS_AS(prepare_surface(point), InputError);
}

TEST_CASE("split_solids: a ball in a ball is a cavity, one beside it a solid of its own") {
    const Mesh big = test::sphere(0.5, 3);
    const Mesh small = test::moved(test::sphere(0.2, 3), {0.1, 0, 0});
    const Mesh beside = test::moved(test::sphere(0.2, 3), {2, 0, 0});
    const std::vector<Solid> solids =
        split_solids(prepare_surface(test::together(test::together(big, small), beside)));
    REQUIRE(solids.size() == 2);
    CHECK(solids[0].cavity_count == 1);
    CHECK(solids[1].cavity_count == 0);
    const double unit = solids[0].surface.world_from_model.scale;
    const double expected = (volume_of(prepare_surface(big).surface) -
                             0.064 * volume_of(prepare_surface(small).surface));
    CHECK(volume_of(solids[0].surface) / (unit * unit * unit) ==
          doctest::Approx(expected).epsilon(0.01));
}

TEST_CASE("split_solids: an island in a cavity is a solid again") {
    const Mesh nest = test::together(test::together(test::sphere(0.5, 3), test::sphere(0.4, 3)),
                                     test::sphere(0.2, 3));
    const std::vector<Solid> solids = split_solids(prepare_surface(nest));
    REQUIRE(solids.size() == 2);
    CHECK(solids[0].cavity_count == 1);
    CHECK(solids[1].cavity_count == 0);
}

TEST_CASE("winding_number: 1 inside, 0 outside, and a half on an open half sphere's rim plane") {
    const PreparedSurface prepared = prepare_surface(test::sphere(0.5, 3));
    const Surface& s = prepared.surface;
    CHECK(winding_number(s.positions, s.triangles, DVec3(0.1, 0.2, 0.0)) == doctest::Approx(1.0));
    CHECK(winding_number(s.positions, s.triangles, DVec3(0.9, 0.2, 0.0)) == doctest::Approx(0.0));
    std::vector<Triangle> upper;
    for (const Triangle& t : s.triangles) {
        if ((s.positions[t.x] + s.positions[t.y] + s.positions[t.z]).z > 0) upper.push_back(t);
    }
    CHECK(winding_number(s.positions, upper, DVec3(0.0)) == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("SurfaceQuery: nearest point, first hit and winding number of the cube") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const SurfaceQuery query(prepared.surface);
    const auto nearest = query.nearest({0.3f, 0.1f, 0.0f});
    CHECK(nearest.distance == doctest::Approx(0.2));
    CHECK(glm::distance(nearest.point, Vec3(0.5f, 0.1f, 0.0f)) < 1e-6f);
    const auto corner = query.nearest({1.5f, 1.5f, 1.5f});
    CHECK(corner.distance == doctest::Approx(std::sqrt(3.0)));
    const auto hit = query.first_hit({0, 0, 0}, {2, 0, 0});
    REQUIRE(hit.has_value());
    CHECK(hit->fraction == doctest::Approx(0.25));
    CHECK_FALSE(query.first_hit({0, 0, 0}, {0.4f, 0, 0}).has_value());
    CHECK(query.winding_number({0, 0, 0}) == doctest::Approx(1.0));
}
