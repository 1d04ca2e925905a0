#include "zskel/io/range_image.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "zskel/visibility/cube_map.h"

using namespace zskel;

namespace {

constexpr int kFacePx = 4;
constexpr int kWidth = 64;  // four texels of four pixels to a face
constexpr DVec3 kNoForce(0.0);

std::vector<float> uniform_map(float distance) {
    return std::vector<float>(6 * kFacePx * kFacePx, distance);
}

void set(std::vector<float>& map, const DVec3& direction, float distance) {
    map[texel_index(texel_of_direction(direction, kFacePx), kFacePx)] = distance;
}

// The middle of a texel of the cross: face by column and row of the cross, then the texel's own.
const std::uint8_t* texel_of(const Image& image, int cell_x, int cell_y, int x, int y) {
    return image.at(cell_x * 16 + x * 4 + 2, cell_y * 16 + y * 4 + 2);
}

}  // namespace

TEST_CASE("range_image: directions land where the cross has them") {
    struct Place {
        DVec3 direction;
        int cell_x, cell_y, x, y;
    };
    // One step off each face's middle, so that every flip would show.
    const Place places[] = {
        {{0.3, 0.6, -1}, 1, 1, 2, 0},  {{1, 0.6, 0.3}, 2, 1, 2, 0}, {{-0.3, 0.6, 1}, 3, 1, 2, 0},
        {{-1, 0.6, -0.3}, 0, 1, 2, 0}, {{0.3, 1, 0.6}, 1, 0, 2, 0}, {{0.3, -1, -0.6}, 1, 2, 2, 0},
    };
    for (const Place& place : places) {
        std::vector<float> map = uniform_map(1.0f);
        set(map, place.direction, 2.0f);
        const Image image = range_image(kFacePx, map, kNoForce, kWidth);
        CAPTURE(place.cell_x);
        CAPTURE(place.cell_y);
        CHECK(texel_of(image, place.cell_x, place.cell_y, place.x, place.y)[0] < 50);
        int dark = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3)
            dark += image.pixels[i] < 50 ? 1 : 0;
        CHECK(dark <= 16);
        CHECK(dark >= 9);  // less a seam between faces
    }
}

TEST_CASE("range_image: the nearer the brighter, and a miss is no grey") {
    std::vector<float> map = uniform_map(2.0f);
    set(map, {0.3, 0.3, -1}, 1.0f);
    set(map, {-0.3, 0.3, -1}, 4.0f);
    set(map, {0.3, -0.3, -1}, kInfinity);
    const Image image = range_image(kFacePx, map, kNoForce, kWidth);
    const int nearest = texel_of(image, 1, 1, 2, 1)[0];
    const int farthest = texel_of(image, 1, 1, 1, 1)[0];
    const int between = texel_of(image, 1, 1, 1, 2)[0];
    CHECK(nearest > between + 50);
    CHECK(between > farthest + 50);
    const std::uint8_t* miss = texel_of(image, 1, 1, 2, 2);
    CHECK(miss[0] > miss[1] + 50);
}

TEST_CASE("range_image: the force is marked where it points, its opposite with a ring") {
    const Image image = range_image(kFacePx, uniform_map(1.0f), {0, 0, -3}, 640);
    const std::uint8_t* disc = image.at(240, 240);
    CHECK(disc[0] > disc[2] + 150);
    const std::uint8_t* hole = image.at(560, 240);
    CHECK(hole[0] == hole[2]);
    const std::uint8_t* ring = image.at(560 + static_cast<int>(std::tan(0.045) * 80.0), 240);
    CHECK(ring[0] > ring[2] + 80);
}

TEST_CASE("range_image: a map without hits or with one distance is drawn too") {
    CHECK(texel_of(range_image(kFacePx, uniform_map(kInfinity), kNoForce, kWidth), 1, 1, 1, 1)[1] <
          150);
    CHECK(texel_of(range_image(kFacePx, uniform_map(1.0f), kNoForce, kWidth), 1, 1, 1, 1)[1] > 200);
}
