#include "zskel/mesh/topology.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace zskel {
namespace {

using Triangles = std::vector<Triangle>;

const Triangles kTetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::size_t vertices_of(const Triangles& triangles) {
    std::uint32_t largest = 0;
    for (const Triangle& t : triangles) largest = std::max({largest, t.x, t.y, t.z});
    return largest + 1;
}

Topology topology_of(const Triangles& triangles) {
    return find_topology(vertices_of(triangles), triangles);
}

Triangles shifted(Triangles triangles, std::uint32_t by) {
    for (Triangle& t : triangles) t += Triangle(by);
    return triangles;
}

Triangles joined(Triangles a, const Triangles& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// A closed grid of n by n quads, cut; handles by construction: one.
Triangles torus(std::uint32_t n) {
    Triangles triangles;
    const auto at = [n](std::uint32_t i, std::uint32_t j) { return (i % n) * n + j % n; };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return triangles;
}

/// A strip of n quads whose ends meet after half a turn when `is_twisted`.
Triangles strip(std::uint32_t n, bool is_twisted) {
    Triangles triangles;
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool is_last = i + 1 == n;
        std::uint32_t low = is_last ? 0 : 2 * i + 2;
        std::uint32_t high = is_last ? 1 : 2 * i + 3;
        if (is_last && is_twisted) std::swap(low, high);
        triangles.emplace_back(2 * i, low, high);
        triangles.emplace_back(2 * i, high, 2 * i + 1);
    }
    return triangles;
}

TEST_CASE("find_topology: a tetrahedron is a closed sphere") {
    const Topology topology = topology_of(kTetrahedron);
    REQUIRE(topology.components.size() == 1);
    const TopologyComponent& sphere = topology.components[0];
    CHECK(sphere.triangle_count == 4);
    CHECK(sphere.vertex_count == 4);
    CHECK(sphere.euler_characteristic == 2);
    CHECK(sphere.genus == 0);
    CHECK(sphere.is_closed);
    CHECK(sphere.is_manifold);
    CHECK(sphere.is_oriented);
    CHECK(topology.boundary_loops.empty());
    CHECK(topology.vertex_of_copy.size() == 4);
}

TEST_CASE("find_topology: a torus has one handle") {
    const Topology topology = topology_of(torus(5));
    REQUIRE(topology.components.size() == 1);
    CHECK(topology.components[0].euler_characteristic == 0);
    CHECK(topology.components[0].genus == 1);
    CHECK(topology.components[0].is_closed);
}

TEST_CASE("find_topology: a torus with a hole keeps its handle and gains a boundary loop") {
    Triangles triangles = torus(5);
    triangles.pop_back();
    const Topology topology = topology_of(triangles);
    CHECK(topology.components[0].genus == 1);
    CHECK(topology.components[0].boundary_loops == 1);
    CHECK_FALSE(topology.components[0].is_closed);
    CHECK(topology.boundary_edges.size() == 3);
    REQUIRE(topology.boundary_loops.size() == 1);
    CHECK(topology.boundary_loops[0].size() == 3);
}

TEST_CASE("find_topology: parts without a common edge are components, in order") {
    const Topology topology = topology_of(joined(kTetrahedron, shifted(torus(4), 4)));
    REQUIRE(topology.components.size() == 2);
    CHECK(topology.components[0].genus == 0);
    CHECK(topology.components[1].genus == 1);
    CHECK(topology.component_of_triangle.front() == 0);
    CHECK(topology.component_of_triangle.back() == 1);
}

TEST_CASE("find_topology: a ring has two boundary loops, a Moebius strip one and no orientation") {
    const Topology ring = topology_of(strip(6, false));
    CHECK(ring.components[0].boundary_loops == 2);
    CHECK(ring.components[0].genus == 0);
    CHECK(ring.components[0].is_orientable);
    CHECK(ring.inconsistent_edges.empty());

    const Topology moebius = topology_of(strip(6, true));
    REQUIRE(moebius.components.size() == 1);
    CHECK_FALSE(moebius.components[0].is_orientable);
    CHECK_FALSE(moebius.components[0].is_oriented);
    CHECK(moebius.components[0].is_manifold);
    CHECK_FALSE(moebius.components[0].genus.has_value());
    CHECK(moebius.boundary_loops.size() == 1);
    CHECK(moebius.inconsistent_edges.size() == 1);
    CHECK(moebius.non_manifold_vertices.empty());
}

TEST_CASE("find_topology: one triangle turned over is found and turned back") {
    Triangles triangles = torus(6);
    std::swap(triangles[10].y, triangles[10].z);
    const Topology topology = topology_of(triangles);
    CHECK(topology.inconsistent_edges.size() == 3);
    CHECK_FALSE(topology.components[0].is_oriented);
    CHECK(topology.components[0].is_orientable);
    CHECK(topology.components[0].genus == 1);
    CHECK(std::count(topology.is_turned.begin(), topology.is_turned.end(), true) == 1);
    CHECK(topology.is_turned[10]);
}

TEST_CASE("find_topology: three triangles at an edge are a non-manifold edge") {
    const Topology topology = topology_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    REQUIRE(topology.components.size() == 1);
    CHECK(topology.non_manifold_edges == std::vector<glm::uvec2>{{0, 1}});
    CHECK_FALSE(topology.components[0].is_manifold);
    CHECK_FALSE(topology.components[0].genus.has_value());
    CHECK(topology.boundary_edges.size() == 6);
    CHECK(topology.inconsistent_edges.empty());
}

TEST_CASE("find_topology: two tetrahedra that share an edge are one part, cut open there") {
    const Topology topology = topology_of(
        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {4, 0, 5}});
    REQUIRE(topology.components.size() == 1);
    CHECK(topology.non_manifold_edges.size() == 1);
    CHECK(topology.boundary_edges.empty());
    CHECK(topology.boundary_loops.empty());
    CHECK_FALSE(topology.components[0].is_closed);
    CHECK(topology.vertex_of_copy.size() == 8);
}

TEST_CASE(
    "find_topology: parts that touch at a vertex are apart, with a copy each and a way back") {
    const Triangles second = {{0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}};
    const Topology topology = topology_of(joined(kTetrahedron, second));
    REQUIRE(topology.components.size() == 2);
    CHECK(topology.components[0].is_manifold);
    CHECK(topology.components[1].genus == 0);
    CHECK(topology.non_manifold_vertices == std::vector<std::uint32_t>{0});
    CHECK(topology.vertex_of_copy.size() == 8);
    CHECK(std::count(topology.vertex_of_copy.begin(), topology.vertex_of_copy.end(), 0U) == 2);
}

TEST_CASE("find_topology: a part that touches itself at a vertex is not manifold") {
    // A ring whose outlines meet in one vertex.
    Triangles triangles = strip(8, false);
    for (Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) t[k] = t[k] == 9 ? 0 : t[k];
    }
    const Topology topology = topology_of(triangles);
    REQUIRE(topology.components.size() == 1);
    CHECK_FALSE(topology.components[0].is_manifold);
    CHECK(topology.non_manifold_vertices == std::vector<std::uint32_t>{0});
    CHECK(topology.components[0].genus == 0);
    CHECK(topology.boundary_loops.size() == 2);
}

TEST_CASE("find_topology: triangles that repeat a corner are left out") {
    const Topology topology = topology_of(joined({{0, 0, 1}, {2, 2, 2}}, kTetrahedron));
    CHECK(topology.components.size() == 1);
    CHECK(topology.component_of_triangle[0] == kNone);
    CHECK(topology.component_of_triangle[2] == 0);
    CHECK(topology.components[0].genus == 0);
}

TEST_CASE("find_topology: two triangles back to back are a closed sphere") {
    for (const Triangle& back : {Triangle(0, 2, 1), Triangle(0, 1, 2)}) {
        const Topology topology = topology_of({{0, 1, 2}, back});
        CHECK(topology.components[0].is_closed);
        CHECK(topology.components[0].euler_characteristic == 2);
        CHECK(topology.components[0].genus == 0);
    }
}

TEST_CASE("find_topology: no triangles, no components") {
    CHECK(find_topology(3, {}).components.empty());
}

TEST_CASE("find_topology: every order of a torus's triangles gives the same numbers") {
    Triangles triangles = torus(7);
    for (std::size_t step = 1; step < 40; ++step) {
        std::rotate(triangles.begin(), triangles.begin() + 1, triangles.end());
        std::swap(triangles[step], triangles[triangles.size() - step]);
        const Topology topology = topology_of(triangles);
        CHECK(topology.components[0].genus == 1);
        CHECK(topology.vertex_of_copy.size() == 49);
    }
}

}  // namespace
}  // namespace zskel
