#include "zskel/io/view.h"

#include <doctest/doctest.h>

#include "support/box.h"
#include "zskel/core/error.h"
#include "zskel/mesh/surface.h"

using namespace zskel;

namespace {

constexpr float kRounding = 1e-5f;

// Rows of the rotation: the camera's right, up and back in world space.
Vec3 axis_of(const Camera& camera, int row) {
    return {camera.view_from_world[0][row], camera.view_from_world[1][row],
            camera.view_from_world[2][row]};
}

// Stands on four feet that reach farther out than all else.
Mesh make_table(const DVec3& up) {
    const auto place = [&](const DVec3& p) {
        return up.y != 0.0 ? p * DVec3(up.y, up.y, 1.0) : DVec3(p.x, -p.z, p.y);
    };
    Mesh mesh;
    const auto add = [&](const DVec3& a, const DVec3& b) {
        test::add_box(mesh, glm::min(place(a), place(b)), glm::max(place(a), place(b)));
    };
    add({-0.6, 0.6, -0.2}, {0.6, 0.8, 0.2});
    for (const double x : {-0.8, 0.8}) {
        for (const double z : {-0.35, 0.35}) {
            add({x - 0.05, 0.0, z - 0.05}, {x + 0.05, 0.6, z + 0.05});
            add({x - 0.15, 0.0, z - 0.15}, {x + 0.15, 0.01, z + 0.15});
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("parse_view: names and angles") {
    CHECK(parse_view("front").azimuth_deg == 0.0);
    CHECK(parse_view("left").azimuth_deg == -90.0);
    CHECK(parse_view("top").elevation_deg == 90.0);
    CHECK(parse_view("30,-20.5").azimuth_deg == 30.0);
    CHECK(parse_view("30,-20.5").elevation_deg == -20.5);
    CHECK_FALSE(parse_view("30,20").is_z_up);
    CHECK(parse_view("30,20,z").is_z_up);
    CHECK(parse_view("iso,z").is_z_up);
}

TEST_CASE("parse_view: anything else is a UsageError") {
    for (const char* text : {"", "Front", "front ", "30", "30,", ",30", "30,91", "400,0", "nan,0",
                             "1,2,3", "1;2", ",z"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_view(text), UsageError);
    }
}

TEST_CASE("aim_camera: named views look along their axes") {
    const PreparedSurface box = prepare_surface(test::make_box({-1, -2, -3}, {1, 2, 3}));
    const auto back_of = [&](const char* text) {
        return axis_of(aim_camera(box.surface, parse_view(text), 400, 300), 2);
    };
    const auto up_of = [&](const char* text) {
        return axis_of(aim_camera(box.surface, parse_view(text), 400, 300), 1);
    };
    const auto close = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < kRounding; };
    CHECK(close(back_of("front"), {0, 0, 1}));
    CHECK(close(back_of("right"), {1, 0, 0}));
    CHECK(close(back_of("top"), {0, 1, 0}));
    CHECK(close(up_of("top"), {0, 0, -1}));
    CHECK(close(back_of("front,z"), {0, -1, 0}));
    CHECK(close(up_of("front,z"), {0, 0, 1}));
    CHECK(close(back_of("right,z"), {1, 0, 0}));
}

TEST_CASE("aim_camera: the whole surface is in the picture and fills it") {
    const PreparedSurface box = prepare_surface(test::make_box({-1, -2, -3}, {1, 2, 3}));
    for (const char* text : {"", "front", "top", "iso", "77,-40", "iso,z"}) {
        CAPTURE(text);
        const std::optional<View> view =
            *text != '\0' ? std::optional(parse_view(text)) : std::nullopt;
        const Camera camera = aim_camera(box.surface, view, 400, 300);
        glm::vec2 low(1e9f);
        glm::vec2 high(-1e9f);
        for (const Vec3& p : box.surface.positions) {
            low = glm::min(low, camera.pixel_of(p, 400, 300));
            high = glm::max(high, camera.pixel_of(p, 400, 300));
        }
        CHECK(low.x > 10.0f);
        CHECK(low.y > 10.0f);
        CHECK(high.x < 390.0f);
        CHECK(high.y < 290.0f);
        CHECK(std::max((high.x - low.x) / 400.0f, (high.y - low.y) / 300.0f) ==
              doctest::Approx(0.88).epsilon(0.01));
    }
}

TEST_CASE("aim_camera: what stands is shown upright, whichever way up the file has it") {
    for (const DVec3& up : {DVec3(0, 1, 0), DVec3(0, -1, 0), DVec3(0, 0, 1)}) {
        CAPTURE(up.y);
        const PreparedSurface table = prepare_surface(make_table(up));
        const Camera camera = aim_camera(table.surface, std::nullopt, 400, 300);
        CHECK(glm::dot(axis_of(camera, 1), Vec3(up)) > 0.7f);
        CHECK(glm::dot(axis_of(camera, 2), Vec3(up)) > 0.1f);  // from above
    }
}

TEST_CASE("aim_camera: without a foot the axis of least spread is looked along") {
    const PreparedSurface slab = prepare_surface(test::make_box({-3, -2, -0.2}, {3, 2, 0.2}));
    const Camera camera = aim_camera(slab.surface, std::nullopt, 400, 300);
    CHECK(axis_of(camera, 2).z > 0.85f);
    CHECK(axis_of(camera, 1).y > 0.9f);
}
