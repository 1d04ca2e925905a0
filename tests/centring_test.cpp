#include "zskel/skeleton/centring.h"

#include <doctest/doctest.h>

#include "support/box.h"
#include "support/drawn_graph.h"
#include "zskel/skeleton/climb.h"

using namespace zskel;

namespace {

struct Solid {
    explicit Solid(const Mesh& mesh) : prepared(prepare_surface(mesh)) {}
    PreparedSurface prepared;
    SurfaceQuery query{prepared.surface};
    float radius = query.nearest(Vec3(0.0f)).distance;
};

}  // namespace

TEST_CASE("climb_to_thickest: the middle of a ball, or as near to it as the reach allows") {
    const Solid ball(test::sphere());
    const float r = ball.radius;
    const Vec3 from = r * Vec3(0.2f, -0.1f, 0.15f);
    const Climb to_middle = climb_to_thickest(from, 0.5, ball.query);
    CHECK(glm::length(to_middle.top) < 0.03f * r);
    CHECK(to_middle.steepness > 0.9f);
    CHECK(to_middle.steepness <= 1.001f);
    const Vec3 outer = r * Vec3(0.0f, 0.8f, 0.0f);
    const Vec3 there = climb_to_thickest(outer, 0.5, ball.query).top;
    const float farthest = 0.5f * ball.query.nearest(outer).distance;
    CHECK(glm::distance(there, outer) <= farthest);
    CHECK(glm::length(there) == doctest::Approx(outer.y - farthest).epsilon(0.01));
}

TEST_CASE("climb_to_thickest: the middle of a plate, and from there nowhere") {
    const Solid plate(test::make_box({-2, -1.5, -0.2}, {2, 1.5, 0.2}));
    const float r = plate.radius;
    const Vec3 middle(1.7f * r, 0.9f * r, 0.0f);
    const Climb nowhere = climb_to_thickest(middle, 0.5, plate.query);
    CHECK(nowhere.top == middle);
    CHECK(nowhere.steepness == 0.0f);
    const Vec3 there = climb_to_thickest(middle + Vec3(0, 0, 0.3f * r), 2.0, plate.query).top;
    CHECK(std::abs(there.z) < 0.03f * r);
    const Vec3 on_surface(0.0f, 0.0f, r);
    const Vec3 still = climb_to_thickest(on_surface, 0.5, plate.query).top;
    CHECK(glm::distance(still, on_surface) < 1e-5f * r);
}

TEST_CASE("centre_branches: a junction stands where its body is thickest") {
    const Solid ball(test::sphere());
    const float r = ball.radius;
    const auto distance_to_middle = [&](double pull) {
        CurveGraph graph;
        const std::uint32_t joint = graph.add(r * Vec3(0.25f, 0.0f, 0.0f));
        for (const Vec3& tip :
             {Vec3(0.8f, 0.0f, 0.4f), Vec3(0.7f, 0.5f, -0.3f), Vec3(0.7f, -0.5f, -0.3f)})
            test::draw(graph, joint, {r * tip});
        RefineOptions options;
        options.junction_pull = pull;
        centre_branches(graph, ball.query, options);
        CHECK(graph.at(joint).x > 0.0f);  // nearer, but its branches hold it
        return glm::length(graph.at(joint));
    };
    const float pulled = distance_to_middle(RefineOptions{}.junction_pull);
    const float held = distance_to_middle(0.0);
    CAPTURE(pulled / r);
    CAPTURE(held / r);
    CHECK(pulled < 0.15f * r);
    CHECK(held > 0.25f * r);
}
