// The zero surface of sampled values.
#include "zskel/mesh/level_set.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "zskel/mesh/signed_volume.h"
#include "zskel/mesh/topology.h"

using namespace zskel;

namespace {

// Blocks of `side` along each axis.
std::vector<LevelSetBlock> sampled(int side, const std::function<double(const DVec3&)>& value) {
    std::vector<LevelSetBlock> blocks;
    for (int b = 0; b < side * side * side; ++b) {
        LevelSetBlock block{{b / (side * side), b / side % side, b % side}, {}};
        for (int v = 0; v < 512; ++v) {
            const glm::ivec3 place =
                block.at * kLevelSetBlock + glm::ivec3(v / 64, v / 8 % 8, v % 8);
            block.values.push_back(static_cast<float>(value(DVec3(place))));
        }
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace

TEST_CASE("mesh_level_set: a ball over several blocks is closed, outward and where it should be") {
    const DVec3 centre(11.3, 11.8, 12.1);
    const double radius = 7.4;
    const LevelSetMesh mesh = mesh_level_set(
        sampled(3, [&](const DVec3& p) { return glm::distance(p, centre) - radius; }));
    const Topology topology = find_topology(mesh.positions.size(), mesh.triangles);
    REQUIRE(topology.components.size() == 1);
    CHECK(topology.components[0].is_closed);
    CHECK(topology.components[0].is_oriented);
    CHECK(topology.components[0].genus == 0);
    CHECK(signed_volume(mesh.positions, mesh.triangles) ==
          doctest::Approx(4.0 / 3.0 * 3.14159265 * std::pow(radius, 3)).epsilon(0.02));
    // Distance is convex along an edge, at most sqrt(3) long: the chord's sagitta.
    const double sagitta = 3.0 / (8.0 * (radius - 1.0));
    for (const DVec3& p : mesh.positions)
        CHECK(glm::distance(p, centre) == doctest::Approx(radius).epsilon(sagitta / radius));
}

TEST_CASE("mesh_level_set: noise has a closed, manifold surface") {
    std::mt19937 random(7);
    const auto noise = [&](const DVec3& p) {
        const bool border =
            glm::min(glm::min(p.x, p.y), p.z) < 1.0 || glm::max(glm::max(p.x, p.y), p.z) > 14.0;
        const double value = static_cast<double>(random() % 2001) / 1000.0 - 1.0;
        return border ? 1.0 : value == 0.0 ? 0.5 : value;
    };
    const LevelSetMesh mesh = mesh_level_set(sampled(2, noise));
    CHECK(mesh.triangles.size() > 1000);
    const Topology topology = find_topology(mesh.positions.size(), mesh.triangles);
    CHECK(topology.boundary_edges.empty());
    CHECK(topology.non_manifold_edges.empty());
    CHECK(topology.non_manifold_vertices.empty());
    CHECK(topology.inconsistent_edges.empty());
}

TEST_CASE("mesh_level_set: cells that lack a corner are left out; one value stands for a block") {
    std::vector<LevelSetBlock> blocks{{{0, 0, 0}, {-1.0f}}, {{1, 0, 0}, {1.0f}}};
    const LevelSetMesh wall = mesh_level_set(blocks);
    REQUIRE(!wall.triangles.empty());
    for (const DVec3& p : wall.positions) CHECK(p.x == doctest::Approx(7.5));
    blocks.pop_back();
    CHECK(mesh_level_set(blocks).triangles.empty());
}

TEST_CASE("drop_parts: what is asked for goes with its vertices, and the rest is as it was") {
    // Two balls side by side, one of them hollow.
    const auto ball = [](const DVec3& p, double x, double radius) {
        return glm::distance(p, DVec3(x, 8, 8)) - radius;
    };
    const auto blocks = sampled(4, [&](const DVec3& p) {
        const double hollow = std::max(ball(p, 8, 6), -ball(p, 8, 3));
        return std::min(hollow, ball(p, 22, 5));
    });
    LevelSetMesh mesh = mesh_level_set(blocks);
    const LevelSetMesh whole = mesh;
    const auto volume = [&](std::span<const Triangle> part) {
        return signed_volume(mesh.positions, part);
    };
    CHECK(drop_parts(mesh, [&](auto) { return false; }) == 0);
    CHECK(mesh.triangles == whole.triangles);
    CHECK(drop_parts(mesh, [&](auto part) { return volume(part) < 0.0; }) == 1);  // the hollow
    CHECK(volume(mesh.triangles) ==
          doctest::Approx(4.0 / 3.0 * std::numbers::pi * (216.0 + 125.0)).epsilon(0.05));
    CHECK(find_topology(mesh.positions.size(), mesh.triangles).components.size() == 2);
    CHECK(drop_parts(mesh, [&](auto part) { return volume(part) > 600.0; }) == 1);
    for (const DVec3& p : mesh.positions) CHECK(std::abs(ball(p, 22, 5)) < 0.2);
    CHECK(drop_parts(mesh, [](auto) { return true; }) == 1);
    CHECK(mesh.positions.empty());
}
