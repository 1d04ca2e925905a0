#include "zskel/mesh/triangulate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

namespace zskel {
namespace {

using Points = std::vector<DVec3>;

std::vector<std::uint32_t> in_order(std::size_t count) {
    std::vector<std::uint32_t> polygon(count);
    std::iota(polygon.begin(), polygon.end(), 0U);
    return polygon;
}

struct Cut {
    bool is_proper = false;
    std::vector<Triangle> triangles;
};

Cut cut(const Points& points, std::size_t looks_left = 1'000'000'000) {
    Cut result;
    result.is_proper = triangulate(points, in_order(points.size()), result.triangles, looks_left);
    return result;
}

DVec3 area_vector(const Points& p, const Triangle& t) {
    return 0.5 * glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
}

/// Sum of the triangles' areas without sign: equals the polygon's only if none lies outside it.
double total_area(const Points& points, const std::vector<Triangle>& triangles) {
    double sum = 0.0;
    for (const Triangle& t : triangles) sum += glm::length(area_vector(points, t));
    return sum;
}

double smallest_area(const Points& points, const std::vector<Triangle>& triangles) {
    double smallest = kInfinity;
    for (const Triangle& t : triangles) {
        smallest = std::min(smallest, glm::length(area_vector(points, t)));
    }
    return smallest;
}

double polygon_area(const Points& points) {
    DVec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        sum += 0.5 * glm::cross(points[i] - points[0], points[i + 1] - points[0]);
    }
    return glm::length(sum);
}

void check_proper(const Points& points) {
    const Cut result = cut(points);
    CHECK(result.is_proper);
    REQUIRE(result.triangles.size() == points.size() - 2);
    CHECK(total_area(points, result.triangles) ==
          doctest::Approx(polygon_area(points)).epsilon(1e-12));
    for (const Triangle& t : result.triangles) {
        CHECK(glm::dot(area_vector(points, t), area_vector(points, result.triangles[0])) >= 0.0);
    }
}

/// A star with alternating radii: every other corner is a notch.
Points star(std::size_t corners, double inner_radius) {
    Points points;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / corners;
        const double radius = i % 2 == 0 ? 1.0 : inner_radius;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    return points;
}

TEST_CASE("triangulate: a triangle stays as it is") {
    CHECK(cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).triangles ==
          std::vector<Triangle>{Triangle(0, 1, 2)});
}

TEST_CASE("triangulate: convex polygons in any plane") {
    check_proper({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    check_proper({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}});
    check_proper({{0, 0, 0}, {0, 2, 1}, {0, 2, 4}, {0, 1, 5}, {0, -1, 3}});
    check_proper(star(100, 1.0));
}

TEST_CASE("triangulate: a concave quad is cut from its notch, whichever corner is first") {
    const Points arrow = {{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
    for (std::size_t first = 0; first < 4; ++first) {
        Points turned;
        for (std::size_t i = 0; i < 4; ++i) turned.push_back(arrow[(first + i) % 4]);
        check_proper(turned);
    }
}

TEST_CASE("triangulate: concave polygons are cut inside their outline") {
    check_proper({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {0, 1, 0}});
    check_proper(
        {{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}, {0, 4, 0}, {4, 4, 0}, {4, 1, 0}, {0, 1, 0}});
    check_proper(star(10, 0.3));
    check_proper(star(200, 0.05));
    check_proper(star(20000, 0.9));
}

TEST_CASE("triangulate: turning and moving a polygon does not change how it is cut") {
    const Points flat = star(12, 0.4);
    const DVec3 u = glm::normalize(DVec3(1, 2, 3));
    const DVec3 v = glm::normalize(glm::cross(u, DVec3(0.3, -1, 0.2)));
    Points placed;
    for (const DVec3& p : flat) placed.push_back(p.x * u + p.y * v + DVec3(10, 20, 30));
    check_proper(placed);
    CHECK(cut(placed).triangles == cut(flat).triangles);
}

TEST_CASE("triangulate: from any corner and either side a polygon is cut along the same lines") {
    const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (const Points& points : {square, star(12, 0.4), star(40, 0.9)}) {
        std::set<std::set<std::uint32_t>> expected;
        for (int turn = 0; turn < static_cast<int>(2 * points.size()); ++turn) {
            std::vector<std::uint32_t> polygon = in_order(points.size());
            std::rotate(polygon.begin(), polygon.begin() + turn / 2, polygon.end());
            if (turn % 2 == 1) std::reverse(polygon.begin(), polygon.end());
            std::vector<Triangle> triangles;
            std::size_t looks_left = 1'000'000;
            REQUIRE(triangulate(points, polygon, triangles, looks_left));
            std::set<std::set<std::uint32_t>> corners;
            DVec3 area(0.0);
            for (const Triangle& t : triangles) {
                corners.insert({t.x, t.y, t.z});
                area += area_vector(points, t);
            }
            CHECK((area.z > 0.0) == (turn % 2 == 0));
            if (turn == 0) expected = corners;
            CHECK(corners == expected);
        }
    }
}

TEST_CASE("triangulate: corners on straight lines still give triangles with area") {
    const Points square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                           {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    for (std::size_t first = 0; first < square.size(); ++first) {
        Points turned;
        for (std::size_t i = 0; i < square.size(); ++i) {
            turned.push_back(square[(first + i) % square.size()]);
        }
        check_proper(turned);
        CHECK(smallest_area(turned, cut(turned).triangles) > 0.1);
    }
    check_proper({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}});
    CHECK(smallest_area({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}},
                        cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}).triangles) > 0.1);
}

TEST_CASE("triangulate: an outline with a bridge to its hole") {
    check_proper({{0, 0, 0},
                  {4, 0, 0},
                  {4, 4, 0},
                  {0, 4, 0},
                  {0, 0, 0},
                  {1, 1, 0},
                  {1, 3, 0},
                  {3, 3, 0},
                  {3, 1, 0},
                  {1, 1, 0}});
}

TEST_CASE("triangulate: very small, very large and faraway polygons") {
    for (const double scale : {1e-100, 1e-9, 1e9, 1e100}) {
        Points points = star(10, 0.3);
        for (DVec3& p : points) p *= scale;
        CHECK(cut(points).is_proper);
        CHECK(cut(points).triangles == cut(star(10, 0.3)).triangles);
    }
    Points points = star(10, 0.3);
    for (DVec3& p : points) p += DVec3(1e6, -1e6, 1e6);
    CHECK(cut(points).triangles == cut(star(10, 0.3)).triangles);
}

TEST_CASE("triangulate: random stars in random planes") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.1, 1.0);
    for (int round = 0; round < 200; ++round) {
        const std::size_t corners = 4 + random() % 20;
        Points points = star(corners, 1.0);
        for (DVec3& p : points) p *= radius(random);
        const DVec3 tilt(radius(random) - 0.5, radius(random) - 0.5, 0.0);
        for (DVec3& p : points) p.z = glm::dot(tilt, p);
        CAPTURE(round);
        check_proper(points);
    }
}

TEST_CASE("triangulate: without an ear a polygon becomes a fan of n - 2 triangles, and says so") {
    const std::vector<Points> hopeless = {
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                        // bow tie
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},             // a line
        {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},  // a point
        {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 1, 1}, {-1, 1, 0}, {3, 3, 0}, {0, -2, 0}},
    };
    for (std::size_t i = 0; i < hopeless.size(); ++i) {
        CAPTURE(i);
        const Cut result = cut(hopeless[i]);
        CHECK(result.triangles.size() == hopeless[i].size() - 2);
        if (i < 3) CHECK_FALSE(result.is_proper);
    }
}

TEST_CASE("triangulate: every corner is used, whatever the polygon looks like") {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> grid(0, 3);
    for (int round = 0; round < 2000; ++round) {
        Points points(3 + random() % 12);
        for (DVec3& p : points) p = DVec3(grid(random), grid(random), grid(random) / 3);
        const Cut result = cut(points);
        std::vector<bool> is_used(points.size(), false);
        for (const Triangle& t : result.triangles) {
            for (int k = 0; k < 3; ++k) is_used.at(t[k]) = true;
            CHECK((t.x != t.y && t.y != t.z && t.z != t.x));
        }
        CHECK(result.triangles.size() == points.size() - 2);
        CHECK(std::count(is_used.begin(), is_used.end(), false) == 0);
    }
}

}  // namespace
TEST_CASE("triangulate: a winding outline takes few looks, and one that takes many ends in a fan") {
    Points spiral;
    for (const double inner : {0.0, 0.03}) {
        Points turns;
        for (int i = 0; i < 2000; ++i) {
            const double t = i / 2000.0;
            const double r = 0.1 + inner + t;
            turns.emplace_back(r * std::cos(20.0 * std::numbers::pi * t),
                               r * std::sin(20.0 * std::numbers::pi * t), 0.0);
        }
        if (inner > 0.0) std::reverse(turns.begin(), turns.end());
        spiral.insert(spiral.end(), turns.begin(), turns.end());
    }
    CHECK(cut(spiral, 500 * spiral.size()).is_proper);
    // Round and round the same triangle: every corner lies on every ear.
    Points rounds;
    for (int i = 0; i < 30000; ++i)
        rounds.emplace_back(i % 3 == 1 ? 1.0 : 0.0, i % 3 == 2 ? 1.0 : 0.0, 0.0);
    const Cut fan = cut(rounds, 100 * rounds.size());
    CHECK_FALSE(fan.is_proper);
    CHECK(fan.triangles.size() == rounds.size() - 2);
}

}  // namespace zskel
