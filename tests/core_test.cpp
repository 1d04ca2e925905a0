// Ways drawn inside a ball: they are thick in its middle and thin near its surface.
#include <doctest/doctest.h>

#include <set>

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
    std::uint32_t join(std::uint32_t a, std::uint32_t b, std::uint64_t sum = 0) {
        Connection c;
        c.a = a;
        c.b = b;
        c.path = {places_[a], places_[b]};
        c.length = glm::distance(places_[a], places_[b]);
        c.sum = sum;
        connections_.push_back(c);
        return static_cast<std::uint32_t>(connections_.size() - 1);
    }
    std::set<std::uint32_t> lay(const std::vector<std::uint32_t>& core) const {
        const std::vector<std::uint32_t> laid = lay_core(query_, girths_, connections_, core);
        return {laid.begin(), laid.end()};
    }

  private:
    Surface surface_ = prepare_surface(test::sphere(0.5), WorldSize::Spread).surface;
    SurfaceQuery query_{surface_};
    std::vector<Vec3> places_;
    std::vector<float> girths_;
    std::vector<Connection> connections_;
};

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
    CHECK(ball.lay(ring) == std::set<std::uint32_t>(ring.begin(), ring.end()));
    // Shorter, but not round the handle.
    ball.join(left, short_cut, kHandle);
    ball.join(short_cut, right);
    CHECK(ball.lay(ring) == std::set<std::uint32_t>(ring.begin(), ring.end()));
    const std::uint32_t in = ball.join(left, inner);
    const std::uint32_t out = ball.join(inner, right);
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
    CHECK(ball.lay(ring) == std::set<std::uint32_t>(ring.begin(), ring.end()));
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
