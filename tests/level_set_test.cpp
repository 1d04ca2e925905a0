// The zero surface of sampled values.
#include "zskel/mesh/level_set.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

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

double volume(const LevelSetMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles)
        sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z]));
    return sum / 6.0;
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
    CHECK(volume(mesh) ==
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
