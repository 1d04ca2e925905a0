// Ways drawn inside a ball: they are thick in its middle and thin near its surface.
#include <doctest/doctest.h>

#include <set>
#include <utility>

#include "support/shapes.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/core.h"

using namespace zskel;

namespace {

constexpr std::uint64_t kHandle = 7;  // what goes round it counts for so much

class Ball {
  public:
    // At a place in the ball's radii.
    std::uint32_t cluster(const Vec3& place, float girth = 1.0f) {
        places_.push_back(place * 0.5f * static_cast<float>(surface_.world_from_model.scale));
        girths_.push_back(girth);
        return static_cast<std::uint32_t>(places_.size() - 1);
    }
    std::uint32_t join(std::uint32_t a, std::uint32_t b, std::uint64_t sum = 0,
                       bool is_inside = true) {
        Connection c;
        c.a = a;
        c.b = b;
        c.path = {places_[a], places_[b]};
        c.length = glm::distance(places_[a], places_[b]);
        c.sum = sum;
        c.is_inside = is_inside;
        connections_.push_back(c);
        return static_cast<std::uint32_t>(connections_.size() - 1);
    }
    std::set<std::uint32_t> lay(const std::vector<std::uint32_t>& core) const {
        const LaidCore laid = lay_core(query_, girths_, connections_, core);
        CHECK(laid.is_complete);
        return {laid.connections.begin(), laid.connections.end()};
    }

  private:
    Surface surface_ = prepare_surface(test::sphere(0.5), WorldSize::Spread).surface;
    SurfaceQuery query_{surface_};
    std::vector<Vec3> places_;
    std::vector<float> girths_;
    std::vector<Connection> connections_;
};

std::set<std::uint32_t> as_set(const std::vector<std::uint32_t>& numbers) {
    return {numbers.begin(), numbers.end()};
}

}  // namespace

TEST_CASE("core_of: dead ends are taken off, and what joins two cycles is left") {
    std::vector<Connection> connections;
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        Connection& c = connections.emplace_back();
        c.a = a;
        c.b = b;
    };
    // A triangle, a bar to a loop of one cluster with itself, a twig of two, and one left out.
    join(0, 1);
    join(1, 2);
    join(2, 0);
    join(2, 3);
    join(3, 3);
    join(1, 4);
    join(4, 5);
    join(5, 0);
    const std::vector<std::uint32_t> numbers{0, 1, 2, 3, 4, 5, 6};
    CHECK(core_of(connections, numbers, 6) == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
    CHECK(core_of(connections, std::vector<std::uint32_t>{0, 1, 5}, 6).empty());
}

TEST_CASE("lay_core: a ring through a place near the surface goes through the middle instead") {
    Ball ball;
    const std::uint32_t left = ball.cluster({-0.5f, -0.3f, 0});
    const std::uint32_t right = ball.cluster({0.5f, -0.3f, 0}, 2.0f);
    const std::uint32_t outer = ball.cluster({0, 0.9f, 0});
    const std::uint32_t inner = ball.cluster({0, 0, 0});
    const std::uint32_t short_cut = ball.cluster({0, -0.3f, 0});
    const std::uint32_t below = ball.join(right, left, kHandle);  // the other way round it
    const std::vector<std::uint32_t> ring{ball.join(left, outer), ball.join(outer, right), below};
    CHECK(ball.lay(ring) == as_set(ring));
    // Shorter, but not round the handle.
    ball.join(left, short_cut, kHandle);
    ball.join(short_cut, right);
    CHECK(ball.lay(ring) == as_set(ring));
    // Better, but not inside.
    const std::uint32_t out = ball.join(right, inner, 2);  // walked against its sum
    ball.join(left, inner, 2, false);
    CHECK(ball.lay(ring) == as_set(ring));
    const std::uint32_t in = ball.join(left, inner, 2);
    CHECK(ball.lay(ring) == std::set<std::uint32_t>{below, in, out});
}

TEST_CASE("lay_core: a way that gains less than a tenth is left where it is") {
    Ball ball;
    const std::uint32_t left = ball.cluster({-0.5f, 0, 0});
    const std::uint32_t right = ball.cluster({0.5f, 0, 0});
    const std::uint32_t above = ball.cluster({0, 0.1f, 0});
    const std::uint32_t below = ball.cluster({0, -0.09f, 0});
    const std::vector<std::uint32_t> ring{ball.join(left, above), ball.join(above, right),
                                          ball.join(right, left, kHandle)};
    ball.join(left, below);
    ball.join(below, right);
    CHECK(ball.lay(ring) == as_set(ring));
}

TEST_CASE("lay_core: an end slides along the rest of the core, and what it leaves behind goes") {
    Ball ball;
    // Two handles on a bar; the second one hangs on a place near the surface.
    const std::uint32_t first = ball.cluster({-0.6f, 0, 0});
    const std::uint32_t middle = ball.cluster({0, 0, 0});
    const std::uint32_t pocket = ball.cluster({0.1f, 0.93f, 0});
    const std::uint32_t far = ball.cluster({0.6f, 0, 0});
    const std::uint32_t ring = ball.join(first, first, kHandle);
    const std::uint32_t bar = ball.join(first, middle);
    const std::uint32_t up = ball.join(middle, pocket);
    const std::uint32_t over = ball.join(pocket, far);
    const std::uint32_t back = ball.join(far, pocket, 3 * kHandle);
    const std::uint32_t straight = ball.join(middle, far);
    const std::uint32_t home = ball.join(far, middle, 3 * kHandle);
    CHECK(ball.lay({ring, bar, up, over, back}) ==
          std::set<std::uint32_t>{ring, bar, straight, home});
}

TEST_CASE("lay_core: a ring that nothing hangs on is laid from its thickest cluster") {
    for (const bool is_left_thick : {true, false}) {
        Ball ball;
        const std::uint32_t left = ball.cluster({-0.9f, 0.2f, 0}, is_left_thick ? 2.0f : 1.0f);
        const std::uint32_t right = ball.cluster({0.9f, 0.2f, 0}, is_left_thick ? 1.0f : 2.0f);
        const std::vector<std::uint32_t> ring{ball.join(left, right),
                                              ball.join(right, left, kHandle)};
        const std::uint32_t inner = ball.cluster({0, 0, 0});
        const std::uint32_t in_left = ball.join(left, inner);
        const std::uint32_t out_left = ball.join(inner, left, kHandle);
        const std::uint32_t in_right = ball.join(right, inner);
        const std::uint32_t out_right = ball.join(inner, right, kHandle);
        // From its anchor to the middle and round there; the way to it is a dead end.
        const auto expected =
            is_left_thick ? std::set{in_left, out_left} : std::set{in_right, out_right};
        CHECK(ball.lay(ring) == expected);
    }
}

TEST_CASE("lay_core: two ways side by side both move") {
    Ball ball;
    const std::uint32_t left = ball.cluster({-0.6f, 0, 0});
    const std::uint32_t right = ball.cluster({0.6f, 0, 0});
    const auto way = [&](const Vec3& over, std::uint64_t sum) {
        const std::uint32_t c = ball.cluster(over);
        return std::vector{ball.join(left, c, sum), ball.join(c, right)};
    };
    std::vector<std::uint32_t> core{ball.join(left, right)};
    std::set<std::uint32_t> better{core[0]};
    for (const auto& [rim, sum] :
         {std::pair{Vec3(0, 0.95f, 0), kHandle}, std::pair{Vec3(0, -0.95f, 0), 5 * kHandle}}) {
        for (const std::uint32_t i : way(rim, sum)) core.push_back(i);
        for (const std::uint32_t i : way(0.4f * rim, sum)) better.insert(i);
    }
    CHECK(ball.lay(core) == better);
}

TEST_CASE("lay_core: no cycle comes or goes by a way through a cluster twice, or that is none") {
    Ball ball;
    const std::uint32_t u = ball.cluster({-0.3f, 0, 0});
    const std::uint32_t v = ball.cluster({0.3f, 0, 0});
    const std::uint32_t b = ball.cluster({0, -0.3f, 0});
    const std::uint32_t rim = ball.cluster({0, 0.97f, 0});
    const std::uint32_t x = ball.cluster({0, 0.2f, 0});
    const std::uint32_t y = ball.cluster({0, 0.25f, 0});
    const std::uint64_t other = 100;
    std::vector<std::uint32_t> core{ball.join(u, v), ball.join(v, b, kHandle), ball.join(b, u),
                                    ball.join(u, rim, other), ball.join(rim, v)};
    // A stem on both sides of a ring that counts for as much.
    ball.join(u, x);
    ball.join(x, v);
    ball.join(x, y, other);
    ball.join(y, x);
    CHECK(ball.lay(core).size() == core.size());
    // A ring that goes round nothing is as good as gone, but was asked for.
    const std::vector<std::uint32_t> nothing{ball.join(u, rim), ball.join(rim, v), ball.join(v, u)};
    ball.join(u, b);
    CHECK(!ball.lay(nothing).empty());
}
