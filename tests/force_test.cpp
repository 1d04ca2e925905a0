#include "zskel/visibility/force.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/shapes.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"

using namespace zskel;

namespace {

EyeRecord record_at(const Mesh& mesh, const DVec3& eye_model, int face_px = 32) {
    const PreparedSurface prepared = prepare_surface(mesh);
    const auto source = make_ray_source(prepared.surface, cube_directions(face_px));
    const Vec3 eye = prepared.surface.world_from_model.to_world(eye_model);
    EyeRecord record;
    source->look(std::span(&eye, 1), std::span(&record, 1));
    return record;
}

// Both shapes below fill the unit cube along one axis at least, so world and model lengths agree.
constexpr double kRadius = 0.5;

}  // namespace

TEST_CASE("force_at: zero at the centre of a sphere, a cube and a cylinder") {
    for (const Mesh& mesh : {test::sphere(), test::cube(), test::cylinder(0.2, 1.0)}) {
        const EyeRecord record = record_at(mesh, DVec3(0.0));
        CHECK(glm::length(record.force) < 1e-5f);
        CHECK(record.hit_fraction == doctest::Approx(1.0));
        CHECK(record.back_fraction == doctest::Approx(1.0));
    }
}

TEST_CASE("force_at: near the centre of a sphere of radius R the mean force is -x / (3 R^2)") {
    // The next term is of third order in x/R: (x/R)^2 = 0.0025 here; the facets of the sphere add
    // 0.1 %.
    const double x = 0.05 * kRadius;
    const EyeRecord record = record_at(test::sphere(kRadius, 5), DVec3(x, 0, 0));
    const double expected = -x / (3.0 * kRadius * kRadius);
    CHECK(record.force.x == doctest::Approx(expected).epsilon(0.005));
    CHECK(std::abs(record.force.y) < 0.002 * std::abs(expected));
    CHECK(std::abs(record.force.z) < 0.002 * std::abs(expected));
}

TEST_CASE("force_at: close to a wall it is 1 / (6 h), straight away from the wall") {
    // In front of an infinite wall at distance h: the mean of cos(a) * cos(a) / h over the half
    // sphere. The far walls of the unit cube subtract about 0.3.
    const double h = 0.01;
    const EyeRecord record = record_at(test::cube(), DVec3(0.5 - h, 0, 0), 64);
    CHECK(record.force.x == doctest::Approx(-1.0 / (6.0 * h)).epsilon(0.03));
    CHECK(std::abs(record.force.y) < 1e-3);
    CHECK(record.nearest == doctest::Approx(h).epsilon(1e-3));
    // The cone of cos >= 0.8 meets the side walls first, at 0.5 / tan(36.87 deg) along the force.
    CHECK(record.clearance >= 0.5f * 0.8f / 0.6f - 1e-4f);
    CHECK(record.clearance <= 0.5f * 0.8f / 0.6f * 1.05f);
}

TEST_CASE("force_at: a wall's distance is exact at every texel") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const auto source = make_ray_source(prepared.surface, cube_directions(16));
    const Vec3 eye(0.125f, -0.25f, 0.0625f);
    MapBatch maps;
    source->render(std::span(&eye, 1), maps);
    for (std::size_t i = 0; i < maps.directions; ++i) {
        const DVec3& d = source->directions().unit[i];
        double nearest = 1e9;
        for (int k = 0; k < 3; ++k) {
            const double wall = d[k] > 0 ? 0.5 : -0.5;
            if (d[k] != 0.0) nearest = std::min(nearest, (wall - eye[k]) / d[k]);
        }
        CHECK(maps.distance[i] == doctest::Approx(nearest).epsilon(1e-6));
    }
}

TEST_CASE("force_at: turns with the model") {
    // A quarter turn about z maps a cube map onto itself, so the forces agree to rounding.
    Mesh mesh = test::cylinder(0.2, 1.0);
    for (DVec3& p : mesh.positions) p.x *= 0.5;
    Mesh turned = mesh;
    for (DVec3& p : turned.positions) p = DVec3(-p.y, p.x, p.z);
    const EyeRecord a = record_at(mesh, DVec3(0.02, 0.05, 0.1));
    const EyeRecord b = record_at(turned, DVec3(-0.05, 0.02, 0.1));
    CHECK(b.force.x == doctest::Approx(-a.force.y).epsilon(1e-4));
    CHECK(b.force.y == doctest::Approx(a.force.x).epsilon(1e-4));
    CHECK(b.force.z == doctest::Approx(a.force.z).epsilon(1e-4));
}

TEST_CASE("summarize: the Jacobian is 1 / (3 R^2) at the centre of a sphere") {
    const EyeRecord record = record_at(test::sphere(kRadius, 5), DVec3(0.0));
    const double expected = 1.0 / (3.0 * kRadius * kRadius);
    for (int k = 0; k < 3; ++k)
        CHECK(record.jacobian[static_cast<std::size_t>(k)] ==
              doctest::Approx(expected).epsilon(0.005));
    for (int k = 3; k < 6; ++k)
        CHECK(std::abs(record.jacobian[static_cast<std::size_t>(k)]) < 0.005 * expected);
}

TEST_CASE("summarize: the Jacobian agrees with differences of the force in a convex shape") {
    const Mesh mesh = test::cylinder(0.2, 1.0);
    const DVec3 eye(0.03, 0.02, 0.1);
    const EyeRecord record = record_at(mesh, eye, 64);
    const double h = 1e-3;
    for (int k = 0; k < 3; ++k) {
        DVec3 step(0.0);
        step[k] = h;
        const Vec3 difference =
            record_at(mesh, eye - step, 64).force - record_at(mesh, eye + step, 64).force;
        const double expected = static_cast<double>(difference[k]) / (2.0 * h);
        CHECK(record.jacobian[static_cast<std::size_t>(k)] ==
              doctest::Approx(expected).epsilon(0.03));
    }
}

TEST_CASE(
    "summarize: outside the mesh, front faces prevail; where nothing is seen, there is no force") {
    const EyeRecord outside = record_at(test::cube(), DVec3(0.7, 0.1, 0.0));
    CHECK(outside.back_fraction < 0.5f);
    CHECK(outside.hit_fraction < 0.5f);
    Mesh far_wall;
    far_wall.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    test::add_triangle(far_wall, 0, 1, 2);
    const EyeRecord blind = record_at(far_wall, DVec3(5, 5, 0));
    CHECK(blind.hit_fraction == 0.0f);
    CHECK(blind.force == Vec3(0.0f));
}

TEST_CASE("ray sources: Embree and every ray against every triangle see the same") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const auto embree = make_ray_source(prepared.surface, cube_directions(16));
    const auto brute =
        make_ray_source(prepared.surface, cube_directions(16), RayMethod::BruteForce);
    const Vec3 eye = prepared.surface.world_from_model.to_world({0.33, 0.03, 0.02});
    MapBatch a;
    MapBatch b;
    embree->render(std::span(&eye, 1), a);
    brute->render(std::span(&eye, 1), b);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.directions; ++i) {
        differ += std::abs(a.distance[i] - b.distance[i]) > 1e-4f * b.distance[i] ? 1 : 0;
    }
    // A ray through an edge may fall to either side, or, by brute force, between.
    CHECK(differ <= 2);
}
