#include "zskel/visibility/cube_map.h"

#include <doctest/doctest.h>

#include <numbers>

#include "zskel/core/error.h"

using namespace zskel;

TEST_CASE("cube_faces: right x up is -forward on every face, so that winding is kept") {
    for (const CubeFace& face : cube_faces()) {
        CHECK(glm::cross(face.right, face.up) == -face.forward);
    }
}

TEST_CASE("texel_solid_angle: the texels of a map sum to 4 pi") {
    for (const int px : {4, 16, 17, 128}) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 6u * static_cast<unsigned>(px * px); ++i) {
            sum += texel_solid_angle(texel_at(i, px), px);
        }
        CHECK(sum == doctest::Approx(4.0 * std::numbers::pi).epsilon(1e-12));
    }
}

TEST_CASE("texel_solid_angle: the corner texel is the smallest, the middle one the largest") {
    const int px = 15;
    const double corner = texel_solid_angle({0, 0, 0}, px);
    const double middle = texel_solid_angle({0, px / 2, px / 2}, px);
    for (std::size_t i = 0; i < 6u * px * px; ++i) {
        const double angle = texel_solid_angle(texel_at(i, px), px);
        CHECK(angle >= corner * (1.0 - 1e-12));
        CHECK(angle <= middle * (1.0 + 1e-12));
    }
}

TEST_CASE("texel_of_direction: undoes texel_direction on every texel") {
    const int px = 16;
    for (std::size_t i = 0; i < 6u * px * px; ++i) {
        const DVec3 direction = texel_direction(texel_at(i, px), px);
        CHECK(texel_index(texel_of_direction(3.7 * direction, px), px) == i);
    }
}

TEST_CASE("cube_directions: weights sum to 1 and directions average to zero") {
    const Directions directions = cube_directions(16);
    double sum = 0.0;
    DVec3 mean(0.0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        sum += directions.weight[i];
        mean += directions.weight[i] * directions.unit[i];
        CHECK(glm::length(directions.unit[i]) == doctest::Approx(1.0).epsilon(1e-14));
    }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-13));
    CHECK(glm::length(mean) < 1e-14);
}

TEST_CASE("cube_directions: a size out of range is a usage error") {
    CHECK_THROWS_AS(cube_directions(3), UsageError);
    CHECK_THROWS_AS(cube_directions(1025), UsageError);
}

TEST_CASE("radial_directions: unit, even, and balanced") {
    const Directions directions = radial_directions(197);
    DVec3 mean(0.0);
    for (const DVec3& d : directions.unit) {
        CHECK(glm::length(d) == doctest::Approx(1.0).epsilon(1e-14));
        mean += d / 197.0;
    }
    CHECK(glm::length(mean) < 0.005);
    CHECK_THROWS_AS(radial_directions(3), UsageError);
}
