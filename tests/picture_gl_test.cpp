#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "support/box.h"
#include "zskel/core/error.h"
#include "zskel/io/picture.h"
#include "zskel/mesh/surface.h"
#include "zskel/visibility/backend.h"

using namespace zskel;

namespace {

constexpr PictureOptions kSmall{400, 300, std::nullopt};

struct Sample {
    PreparedSurface prepared = prepare_surface(test::make_box({10, 10, 10}, {16, 14, 11}));
    SkeletonGraph graph;
    Sample() {
        // A junction in the middle, three ends, and an ordinary node on one arm.
        for (const DVec3& p : {DVec3(13, 12, 10.5), DVec3(11, 12, 10.5), DVec3(15, 13, 10.5),
                               DVec3(15, 11, 10.5), DVec3(12, 12, 10.5)}) {
            graph.nodes.push_back({p, 0.4, 0});
        }
        graph.edges = {{0, 2}, {0, 3}, {0, 4}, {1, 4}};
    }
    const Surface& surface() const { return prepared.surface; }
    Vec3 world(const DVec3& model) const { return surface().world_from_model.to_world(model); }
    const std::uint8_t* pixel(const Image& image, const DVec3& model) const {
        const Camera camera = aim_camera(surface(), std::nullopt, image.width, image.height);
        const glm::vec2 at = camera.pixel_of(world(model), image.width, image.height);
        return image.at(static_cast<int>(at.x), static_cast<int>(at.y));
    }
};

bool is_end_color(const std::uint8_t* p) {
    return p[0] > p[1] + 50 && p[1] > p[2];
}
bool is_junction_color(const std::uint8_t* p) {
    return p[2] > p[0] + 50 && p[1] > p[0];
}
bool is_dark(const std::uint8_t* p) {
    return std::max({p[0], p[1], p[2]}) < 130;
}
bool is_grey(const std::uint8_t* p) {
    return std::abs(p[0] - p[2]) < 25;
}

}  // namespace

TEST_CASE("draw_skeleton: model, tubes, ends and junctions in their colours at their places") {
    const auto context = open_picture_context();
    const Sample sample;
    const Image image = draw_skeleton(*context, sample.surface(), sample.graph, kSmall);
    CHECK(image.width == 400);
    CHECK(image.height == 300);
    CHECK(is_junction_color(sample.pixel(image, {13, 12, 10.5})));
    CHECK(is_end_color(sample.pixel(image, {11, 12, 10.5})));
    CHECK(is_end_color(sample.pixel(image, {15, 13, 10.5})));
    CHECK(is_end_color(sample.pixel(image, {15, 11, 10.5})));
    for (const DVec3& tube : {DVec3(12, 12, 10.5), DVec3(14, 12.5, 10.5), DVec3(14, 11.5, 10.5)}) {
        CHECK(is_dark(sample.pixel(image, tube)));
        CHECK(is_grey(sample.pixel(image, tube)));
    }
    const std::uint8_t* model = sample.pixel(image, {13, 13.3, 10.5});
    CHECK(is_grey(model));
    CHECK(model[0] < 250);
    CHECK(model[0] > 150);
    CHECK(*image.at(0, 0) == 255);
    CHECK(*image.at(399, 299) == 255);
}

TEST_CASE(
    "draw_skeleton: every vertex in the colour that it is given, skeleton and lines as ever") {
    const auto context = open_picture_context();
    const Sample sample;
    std::vector<Vec3> tints;
    for (const Vec3& p : sample.surface().positions)
        tints.push_back(p.x < sample.world({13, 12, 10.5}).x ? Vec3(0.9f, 0.2f, 0.2f)
                                                             : Vec3(0.2f, 0.2f, 0.9f));
    const Image image = draw_skeleton(*context, sample.surface(), sample.graph, kSmall, tints);
    const std::uint8_t* left = sample.pixel(image, {11.3, 13.3, 10.5});
    const std::uint8_t* right = sample.pixel(image, {14.7, 13.7, 10.5});
    CHECK(left[0] > left[2] + 25);
    CHECK(right[2] > right[0] + 25);
    CHECK(is_junction_color(sample.pixel(image, {13, 12, 10.5})));
    CHECK(is_dark(sample.pixel(image, {12, 12, 10.5})));
    CHECK(*image.at(0, 0) == 255);
}

TEST_CASE("draw_skeleton: the same picture twice has the same bytes") {
    const auto context = open_picture_context();
    const Sample sample;
    const Image once = draw_skeleton(*context, sample.surface(), sample.graph, kSmall);
    CHECK(draw_skeleton(*context, sample.surface(), sample.graph, kSmall).pixels == once.pixels);
}

TEST_CASE("draw_skeleton: the bands of a tall picture meet without a seam") {
    const auto context = open_picture_context();
    const Sample sample;
    const Image image =
        draw_skeleton(*context, sample.surface(), {}, {96, 600, parse_view("front")});
    for (int row = 250; row < 262; ++row) {
        for (int column = 20; column < 76; ++column) {
            CHECK(std::abs(*image.at(column, row) - *image.at(column, row + 1)) <= 2);
        }
    }
}

TEST_CASE("draw_paths: ways are blue, the nodes at their ends lie over them") {
    const auto context = open_picture_context();
    const Sample sample;
    const std::vector<std::vector<Vec3>> paths{
        {sample.world({11, 11, 10.5}), sample.world({12, 12, 10.5}), sample.world({13, 12, 10.5})},
        {},
        {sample.world({15, 11, 10.5})}};
    const Vec3 nodes[] = {sample.world({13, 12, 10.5})};
    const Image image = draw_paths(*context, sample.surface(), paths, nodes, kSmall);
    CHECK(is_end_color(sample.pixel(image, {13, 12, 10.5})));
    const std::uint8_t* way = sample.pixel(image, {12, 12, 10.5});
    CHECK(way[2] > way[0] + 20);
}

TEST_CASE("draw_skeleton: a picture of no size is a UsageError") {
    const auto context = open_picture_context();
    const Sample sample;
    CHECK_THROWS_AS(draw_skeleton(*context, sample.surface(), {}, {0, 300, {}}), UsageError);
    CHECK_THROWS_AS(draw_skeleton(*context, sample.surface(), {}, {400, 10000, {}}), UsageError);
}
