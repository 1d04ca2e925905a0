// The record's Jacobian against closed forms and against differences of the force.
//
// Closed forms. With c the cosine between a direction and the x axis, all means over the sphere:
//  - ball of radius R, eye at x: r = sqrt(R^2 - x^2 s^2) - x c, s^2 = 1 - c^2, so
//    1/r = (x c + sqrt(R^2 - x^2 s^2)) / (R^2 - x^2). The root is even in c and the mean of c^2 is
//    1/3: force = -mean(c/r) = -x / (3 (R^2 - x^2)).
//  - slab |x| < R, eye at x: 1/r = |c| / (R -+ x), so force = -(1/(R - x) - 1/(R + x)) / 6, the
//    same.
//  - cylinder of radius R, eye at x off its axis: with s the sine to the axis, r is the chord of
//    the circle over s; the chord is the ball's, with the azimuth in place of c. The mean of
//    s^2 cos(azimuth)^2 is 1/3: the same again.
// The derivative of -force along x is (R^2 + x^2) / (3 (R^2 - x^2)^2). Across, the ball's and the
// cylinder's force points at the axis: 1 / (3 (R^2 - x^2)); along slab and cylinder it is 0.
//
// The record floors n.D at 0.2. Where a closed form or a difference meets smaller values, it says
// so.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "support/models.h"
#include "support/shapes.h"
#include "zskel/core/eigen3.h"
#include "zskel/skeleton/newton.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"

using namespace zskel;

namespace {

constexpr double kGrazingCosine = 0.2;

using Symmetric = std::array<double, 6>;  // xx yy zz xy xz yz

// A surface, seen along the texels of a cube map.
struct Scene {
    Scene(PreparedSurface ready, int face_px)
        : prepared(std::move(ready)),
          source(make_ray_source(prepared.surface, cube_directions(face_px))) {}
    Scene(const Mesh& mesh, int face_px) : Scene(prepare_surface(mesh), face_px) {}

    EyeRecord look(const Vec3& eye) const {
        EyeRecord record;
        source->look(std::span(&eye, 1), std::span(&record, 1));
        return record;
    }

    PreparedSurface prepared;
    std::unique_ptr<VisibilitySource> source;
};

Symmetric jacobian_of(const EyeRecord& record) {
    Symmetric out{};
    std::copy(record.jacobian.begin(), record.jacobian.end(), out.begin());
    return out;
}

double norm(const Symmetric& m) {
    double sum = 0.0;
    for (std::size_t i = 0; i < m.size(); ++i) sum += (i < 3 ? 1.0 : 2.0) * m[i] * m[i];
    return std::sqrt(sum);
}

double relative_difference(Symmetric found, const Symmetric& expected) {
    for (std::size_t i = 0; i < found.size(); ++i) found[i] -= expected[i];
    return norm(found) / norm(expected);
}

// Central differences of -force, symmetrised.
template <typename ForceAt>
Symmetric difference_jacobian(ForceAt force_at_eye, const DVec3& eye, double h) {
    std::array<DVec3, 3> column;
    for (int k = 0; k < 3; ++k) {
        DVec3 step(0.0);
        step[k] = h;
        column[static_cast<std::size_t>(k)] =
            (force_at_eye(eye - step) - force_at_eye(eye + step)) / (2.0 * h);
    }
    return {column[0].x,
            column[1].y,
            column[2].z,
            0.5 * (column[0].y + column[1].x),
            0.5 * (column[0].z + column[2].x),
            0.5 * (column[1].z + column[2].y)};
}

// Every ray cast anew.
Symmetric full_jacobian(const Scene& scene, const Vec3& eye, double h) {
    return difference_jacobian([&](const DVec3& at) { return DVec3(scene.look(Vec3(at)).force); },
                               DVec3(eye), h);
}

// Each direction keeps the plane of the triangle that it hit: 1/r = n.D / n.(corner - eye).
DVec3 frozen_force(const Directions& directions, const MapView& map, const Surface& surface,
                   const DVec3& eye) {
    DVec3 sum(0.0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (map.id[i] == kNone) continue;
        const Triangle& t = surface.triangles[map.id[i]];
        const DVec3 a(surface.positions[t.x]);
        const DVec3 n = glm::normalize(
            glm::cross(DVec3(surface.positions[t.y]) - a, DVec3(surface.positions[t.z]) - a));
        const DVec3& d = directions.unit[i];
        sum -= d * (directions.weight[i] * glm::dot(n, d) / glm::dot(n, a - eye));
    }
    return sum;
}

// Turns grazing texels, whose n.D the record floors, into misses; returns how many.
std::size_t drop_grazing(const Directions& directions, const Surface& surface, MapBatch& map) {
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (map.id[i] == kNone) continue;
        const DVec3 n(surface.triangle_normals[map.id[i]]);
        if (std::abs(glm::dot(n, directions.unit[i])) >= kGrazingCosine) continue;
        map.distance[i] = kInfinity;
        map.id[i] = kNone;
        ++dropped;
    }
    return dropped;
}

// Where seeds of the horse land after their first jump, and where they end.
std::vector<Vec3> horse_eyes(std::size_t count) {
    const Scene scene(test::model("horse"), 16);
    const auto seeds = test::some_seeds(scene.prepared.surface, 29);
    std::vector<Vec3> eyes;
    for (const SettledSeed& seed : settle_seeds_newton(*scene.source, seeds, {})) {
        if (seed.path.size() < 3 || eyes.size() >= count) continue;
        eyes.push_back(seed.path[1]);
        eyes.push_back(seed.path.back());
    }
    return eyes;
}

// Force and Jacobian at x off the centre against the closed forms above; whether the force also
// turns back along y and z.
void check_closed_form(const Scene& scene, double radius, double x, bool turns_y, bool turns_z) {
    CAPTURE(x);
    const EyeRecord record = scene.look(Vec3(static_cast<float>(x), 0, 0));
    const double gap = radius * radius - x * x;
    const double along = (radius * radius + x * x) / (3.0 * gap * gap);
    const double across = 1.0 / (3.0 * gap);
    const Symmetric expected{along, turns_y ? across : 0.0, turns_z ? across : 0.0, 0, 0, 0};
    CHECK(relative_difference(jacobian_of(record), expected) < 0.005);
    CHECK(glm::length(DVec3(record.force) - DVec3(-x / (3.0 * gap), 0, 0)) < 0.01 * radius * along);
}

}  // namespace

TEST_CASE("summarize: force and Jacobian in a ball are the closed forms, at any distance out") {
    // Facets: 0.1 %. No n.D below sqrt(1 - 0.75^2) = 0.66.
    const Scene scene(test::sphere(0.5, 5), 64);
    for (const double share : {0.0, 0.25, 0.5, 0.75})
        check_closed_form(scene, 0.5, share * 0.5, true, true);
}

TEST_CASE("summarize: in a slab only the axis across it has an eigenvalue") {
    // Ten times as wide as thick: of the mean of c^2 = 1/3 the rim takes 0.001 at most, and the
    // floor, at c < 0.2, 0.0007.
    Mesh slab = test::cube();
    for (DVec3& p : slab.positions) p.x *= 0.1;
    const Scene scene(slab, 64);
    for (const double share : {0.0, 0.25, 0.5})
        check_closed_form(scene, 0.05, share * 0.05, false, false);
    const Eigen3 eigen = eigen_symmetric(scene.look(Vec3(0.0f)).jacobian);
    CHECK(std::abs(eigen.vectors[0].x) > 0.9999);
    CHECK(eigen.values[1] < 0.01 * eigen.values[0]);
}

TEST_CASE("summarize: in a cylinder both axes across are equal, and that along it is the caps'") {
    // Directions within acos(c0) of the axis meet the caps, at z = -+L; they take 0.0006 of the
    // mean. Facets of 96 sides: 0.1 %.
    const double radius = 0.1;
    const double half = 0.5;
    const Scene scene(test::cylinder(radius, 2.0 * half), 64);
    for (const double share : {0.0, 0.25, 0.5})
        check_closed_form(scene, radius, share * radius, true, false);
    const double c0 = half / std::hypot(half, radius);
    const Symmetric found = jacobian_of(scene.look(Vec3(0.0f)));
    CHECK(found[0] == doctest::Approx(found[1]).epsilon(1e-3));
    // Across, the mean of s^2 / 2 over c < c0, over R^2; along, that of c^2 over c > c0, over L^2.
    CHECK(found[0] ==
          doctest::Approx((c0 - c0 * c0 * c0 / 3.0) / (2.0 * radius * radius)).epsilon(0.005));
    CHECK(found[2] == doctest::Approx((1.0 - c0 * c0 * c0) / (3.0 * half * half)).epsilon(0.05));
}

TEST_CASE("summarize: on a horse, with what is seen frozen, the Jacobian is the differences'") {
    // A plane at distance n.D r moves by at most 1e-4 nearest, n.D >= 0.2: the next term is below
    // (5e-4)^2. The record's floats leave 6e-8. Grazing texels are left out on both sides.
    const Scene scene(test::model("horse"), 16);
    const Directions& directions = scene.source->directions();
    const Surface& surface = scene.prepared.surface;
    std::size_t dropped = 0;
    double worst = 0.0;
    const std::vector<Vec3> eyes = horse_eyes(60);
    REQUIRE(eyes.size() == 60);
    for (const Vec3& eye : eyes) {
        MapBatch map;
        scene.source->render(std::span(&eye, 1), map);
        dropped += drop_grazing(directions, surface, map);
        const MapView view = map.view(0);
        const EyeRecord record = summarize(directions, view, surface);
        const auto frozen = difference_jacobian(
            [&](const DVec3& at) { return frozen_force(directions, view, surface, at); },
            DVec3(eye), 1e-4 * static_cast<double>(record.nearest));
        worst = std::max(worst, relative_difference(jacobian_of(record), frozen));
    }
    MESSAGE("worst relative difference ", worst, "; grazing texels ",
            static_cast<double>(dropped) / static_cast<double>(eyes.size() * directions.size()));
    CHECK(worst < 1e-6);
}

TEST_CASE("summarize: in convex shapes the Jacobian is that of the force with rays cast anew") {
    // What is seen changes continuously: no term is left out. A texel whose ray passes an edge
    // within the step counts the mean of both sides; at 6x64x64 texels these are too few to tell.
    // n.D >= 0.35 at all these eyes, above the floor.
    Mesh box = test::cube();
    for (DVec3& p : box.positions) p *= DVec3(1.0, 0.8, 0.6);
    const Scene ball(test::sphere(0.5, 5), 64);
    const Scene crate(box, 64);
    for (const Scene* scene : {&ball, &crate}) {
        for (const Vec3& eye :
             {Vec3(0.01f, 0.02f, 0.03f), Vec3(0.1f, 0.07f, 0.04f), Vec3(-0.12f, 0.1f, 0.05f)}) {
            const EyeRecord record = scene->look(eye);
            CHECK(relative_difference(jacobian_of(record), full_jacobian(*scene, eye, 1e-3)) <
                  0.005);
        }
    }
}

TEST_CASE("summarize: on a horse silhouettes add a term that the Jacobian leaves out") {
    // 6x128x128 texels and steps from 0.02 to 0.1 nearest give the same figures to 0.005.
    const Scene scene(test::model("horse"), 48);
    std::vector<double> terms;
    for (const Vec3& eye : horse_eyes(60)) {
        const EyeRecord record = scene.look(eye);
        const double h = 0.02 * static_cast<double>(record.nearest);
        terms.push_back(relative_difference(full_jacobian(scene, eye, h), jacobian_of(record)));
    }
    std::sort(terms.begin(), terms.end());
    const double median = terms[terms.size() / 2];
    const double ninth = terms[terms.size() * 9 / 10];
    MESSAGE("silhouette term over the Jacobian: median ", median, ", 90 % ", ninth, ", worst ",
            terms.back());
    CHECK(median < 0.05);
    CHECK(ninth < 0.15);
    CHECK(terms.back() < 0.25);
    CHECK(terms.back() > 0.02);  // what is tested is there
}
