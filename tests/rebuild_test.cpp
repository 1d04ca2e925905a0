#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "support/extract.h"
#include "support/shapes.h"
#include "zskel/core/error.h"
#include "zskel/io/map_file.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/check.h"
#include "zskel/rebuild/fidelity.h"
#include "zskel/rebuild/watertight.h"
#include "zskel/visibility/cube_map.h"

using namespace zskel;

namespace {

template <typename Distance>
NodeMap map_of(const DVec3& eye, int face_px, Distance distance) {
    NodeMap node{eye, 0, {}};
    for (const DVec3& direction : cube_directions(face_px).unit)
        node.distance.push_back(static_cast<float>(distance(direction)));
    return node;
}

// Of a cube of half side 1 about its middle: what each face sees is one plane.
double to_cube(const DVec3& direction) {
    return 1.0 / std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
}

VisibilityMaps maps_by_cpu(const Mesh& mesh, const SkeletonGraph& graph, int face_px = 32) {
    BackendOptions options;
    options.kind = BackendKind::Cpu;
    options.face_px = face_px;
    return look_from_nodes(mesh, graph, *open_backend(options));
}

Mesh mesh_of(const RebuiltMesh& rebuilt) {
    Mesh mesh;
    mesh.name = "rebuilt";
    mesh.positions = rebuilt.positions;
    mesh.triangles = rebuilt.triangles;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.face_of_triangle.push_back(t);
    mesh.face_count = mesh.triangles.size();
    return mesh;
}

}  // namespace

TEST_CASE("RecallMap: planes come back exactly, however few texels saw them") {
    const RecallMap map(map_of({3, 4, 5}, 8, to_cube), 8);
    for (const DVec3& p : {DVec3(0.2, 0.9, 0.1), DVec3(-0.3, 1.3, 0.2), DVec3(0.1, 2.0, -1.1)}) {
        const Sighting seen = map.look_at(DVec3(3, 4, 5) + p);
        CHECK(seen.inside == doctest::Approx(1.0 - p.y).epsilon(1e-5));
        CHECK(glm::distance(seen.outward, DVec3(0, 1, 0)) < 1e-4);
        CHECK(seen.footprint == doctest::Approx(0.25 * p.y));
    }
}

TEST_CASE("RecallMap: creases stay sharp, on the edges of faces and across texels, both ways") {
    // A cube turned about its middle; and the four beams of a cross, whose inner edges point at it.
    const auto frame = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.4, DVec3(0.3, 0.7, -0.5)));
    const auto cross = [](const DVec3& d) {
        const double x = std::abs(d.x);
        const double y = std::abs(d.y);
        const double walls = 1.0 / std::max(std::min(x, y), std::abs(d.z) / 2.0);
        return std::min(walls, 3.0 / std::max(x, y));
    };
    const auto share_off = [](int face_px, auto&& distance, double tolerance) {
        const RecallMap map(map_of(DVec3(0.0), face_px, distance), face_px);
        const std::vector<DVec3> directions = radial_directions(5000).unit;
        const auto off = std::ranges::count_if(directions, [&](const DVec3& d) {
            return std::abs(map.look_at(distance(d) * d).inside) > tolerance;
        });
        return static_cast<double>(off) / static_cast<double>(directions.size());
    };
    const auto turned_cube = [&](const DVec3& d) { return to_cube(frame * d); };
    const auto turned_cross = [&](const DVec3& d) { return cross(frame * d); };
    for (const int face_px : {8, 16, 32}) CHECK(share_off(face_px, to_cube, 0.001) == 0.0);
    // Interpolated across the creases: 4.9, 7.6 and 6.5 %.
    CHECK(share_off(32, turned_cube, 0.001) < 0.01);
    CHECK(share_off(32, cross, 0.01) < 0.01);
    CHECK(share_off(32, turned_cross, 0.01) < 0.01);
}

TEST_CASE("RecallMap: a ball comes back within the sagitta of a texel, across the edges of faces") {
    constexpr int kFacePx = 16;
    const RecallMap map(map_of(DVec3(0.0), kFacePx, [](const DVec3&) { return 2.0; }), kFacePx);
    const double half_texel = 1.0 / kFacePx;
    const double sagitta = 2.0 * half_texel * half_texel;  // of two texels, with room for corners
    for (const DVec3& direction : radial_directions(5000).unit) {
        const Sighting seen = map.look_at(1.9 * direction);
        CHECK(std::abs(seen.inside - 0.1) < 2.0 * sagitta);
        CHECK(glm::dot(seen.outward, direction) > 0.99);
    }
}

TEST_CASE("RecallMap: what lies behind a step in depth is not believed") {
    // A wall at 1 on one half, at 4 on the other.
    const auto step = [](const DVec3& d) { return to_cube(d) * (d.x < 0.0 ? 1.0 : 4.0); };
    const RecallMap map(map_of(DVec3(0.0), 16, step), 16);
    CHECK(map.look_at({0.001, 2.0, 0.3}).inside < 0.0);
    CHECK(map.look_at({-0.001, 2.0, 0.3}).inside < 0.0);
    CHECK(map.look_at({0.5, 2.0, 0.3}).inside == doctest::Approx(2.0));
}

TEST_CASE("RecallMap: walls too steep for the texels across a groove do not make it deeper") {
    // Depth 0.38 in the two rows of texels at the middle of the face, and what rises from there on
    // both sides would meet at 0.55 between them.
    const auto groove = [](const DVec3& d) {
        const DVec3 size = glm::abs(d);
        if (d.x < std::max(size.y, size.z)) return 0.05;
        return 1.0 / (1.82 * d.x + 13.0 * size.y);
    };
    const RecallMap map(map_of(DVec3(0.0), 16, groove), 16);
    CHECK(map.look_at({0.37, 0.0, 0.0}).inside > 0.0);
    CHECK(map.look_at({0.39, 0.0, 0.0}).inside < 0.0);
    CHECK(map.look_at({0.5, 0.0, 0.0}).inside < 0.0);
}

TEST_CASE("RecallMap: texels that missed end at the ball that is surely free") {
    const auto half_open = [](const DVec3& d) { return d.x < 0.0 ? 1.0 : kInfinity; };
    const RecallMap map(map_of(DVec3(0.0), 16, half_open), 16);
    CHECK(map.look_at({0.9, 0.1, 0.0}).inside > 0.0);
    CHECK(map.look_at({1.1, 0.1, 0.0}).inside < 0.0);
}

TEST_CASE("Recall: of two maps the one that sees past a place has its way") {
    VisibilityMaps maps;
    maps.face_px = 16;
    const auto ball = [](double radius) { return [=](const DVec3&) { return radius; }; };
    maps.nodes = {map_of({0, 0, 0}, 16, ball(1.0)), map_of({1.5, 0, 0}, 16, ball(1.0))};
    const Recall recall(maps);
    const std::vector<std::uint32_t> both{0, 1};
    CHECK(recall.inside({1.5, 0, 0}, both) > 0.0);
    CHECK(recall.inside({0.75, 0, 0}, both) > 0.0);
    CHECK(recall.inside({0.75, 0.9, 0}, both) < 0.0);
    CHECK(recall.maps_about({-0.9, 0, 0}, 0.05) == std::vector<std::uint32_t>{0});
}

TEST_CASE("map file: what was written comes back within one part in 10,000, misses too") {
    VisibilityMaps maps;
    maps.face_px = 8;
    const auto uneven = [](const DVec3& d) {
        return d.z > 0.8 ? kInfinity : 0.003 * std::exp(9.0 * d.x * d.x);
    };
    maps.nodes = {map_of({1e6, -2.5, 1e-9}, 8, uneven),
                  map_of(DVec3(0.0), 8, [](const DVec3&) { return kInfinity; }),
                  map_of({1, 2, 3}, 8, to_cube)};
    maps.nodes[2].solid = 7;
    const std::string bytes = write_visibility_maps(maps);
    CHECK(is_visibility_maps(bytes));
    const VisibilityMaps back = read_visibility_maps(bytes, "a.maps");
    REQUIRE(back.face_px == 8);
    REQUIRE(back.nodes.size() == 3);
    for (std::size_t n = 0; n < 3; ++n) {
        CHECK(back.nodes[n].eye == maps.nodes[n].eye);
        CHECK(back.nodes[n].solid == maps.nodes[n].solid);
        for (std::size_t t = 0; t < maps.nodes[n].distance.size(); ++t) {
            const float wanted = maps.nodes[n].distance[t];
            const float found = back.nodes[n].distance[t];
            CHECK((std::isfinite(wanted) ? std::abs(found / wanted - 1.0f) < 1e-4f
                                         : found == wanted));
        }
    }
    CHECK(write_visibility_maps(back) ==
          write_visibility_maps(read_visibility_maps(write_visibility_maps(back), "b")));
}

TEST_CASE("map file: damaged in any byte or cut anywhere, it is refused or read, never more") {
    VisibilityMaps maps;
    maps.face_px = 4;
    maps.nodes = {map_of({1, 2, 3}, 4, to_cube), map_of({2, 2, 3}, 4, to_cube)};
    const std::string bytes = write_visibility_maps(maps);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        CHECK_THROWS_AS(read_visibility_maps(bytes.substr(0, size), "cut"), InputError);
    // zlib's sum finds what the header does not; bits between its blocks mean nothing.
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (const char flip : {'\x01', '\x80', '\xff'}) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ flip);
            try {
                const VisibilityMaps back = read_visibility_maps(damaged, "damaged");
                CHECK(write_visibility_maps(back) == bytes);
            } catch (const InputError& error) {
                CHECK(std::string(error.what()).starts_with("damaged: "));
            }
        }
    }
    // A header that asks for more than its bytes can hold.
    std::string greedy = bytes;
    const std::uint32_t many = 4000000000u;
    std::memcpy(greedy.data() + 16, &many, 4);
    CHECK_THROWS_WITH_AS(read_visibility_maps(greedy, "greedy"),
                         doctest::Contains("greedy: byte 16: 4000000000 nodes"), InputError);
}

TEST_CASE(
    "rebuild_surface: a ring comes back watertight, with its hole, near the one that was seen") {
    const Mesh ring = test::torus();
    const VisibilityMaps maps = maps_by_cpu(ring, test::extract(ring).graph);
    const Mesh rebuilt = mesh_of(rebuild_surface(maps, {}));
    const MeshReport report = check_mesh(rebuilt);
    REQUIRE(report.components.size() == 1);
    CHECK(report.components[0].is_closed);
    CHECK(report.components[0].is_manifold);
    CHECK(report.components[0].genus == 1);
    CHECK(report.components[0].volume.value_or(0.0) ==
          doctest::Approx(2.0 * 9.8696 * 0.35 * 0.12 * 0.12).epsilon(0.03));
    const double diagonal = box_of(ring.positions).diagonal();
    const SurfaceDistances distances = distances_between(ring, rebuilt);
    CHECK(distances.mean < 0.003 * diagonal);
    CHECK(distances.hausdorff < 0.01 * diagonal);
    CHECK(share_seen(ring, maps, 0.003 * diagonal) > 0.995);
}

TEST_CASE("surfels: none lies off the surface where one limb is seen past another") {
    const Mesh ring = test::torus();
    const VisibilityMaps maps = maps_by_cpu(ring, test::extract(ring).graph);
    std::vector<DVec3> places;
    for (const Surfel& s : Recall(maps).surfels()) places.push_back(s.position);
    REQUIRE(places.size() > 10000);
    const std::vector<double> off = distances_to(ring, places);
    CHECK(*std::ranges::max_element(off) < 0.005 * box_of(ring.positions).diagonal());
}

TEST_CASE("rebuild_surface: the void in a ball stays, other parts stay apart") {
    const Mesh hollow =
        test::together(test::sphere(0.5), test::turned_inside_out(test::sphere(0.2)));
    const Mesh both = test::together(hollow, test::moved(test::sphere(0.3), {2, 0, 0}));
    const Mesh rebuilt = mesh_of(rebuild_surface(maps_by_cpu(both, test::extract(both).graph), {}));
    const MeshReport report = check_mesh(rebuilt);
    CHECK(report.components.size() == 3);
    double volume = 0.0;
    for (const ComponentReport& part : report.components) volume += part.volume.value_or(100.0);
    CHECK(volume == doctest::Approx(4.18879 * (0.125 - 0.008 + 0.027)).epsilon(0.05));
}

TEST_CASE("share_seen: half a ball is half seen from a node that is kept from the rest") {
    // The other half of its map misses, and so ends well before the surface.
    const Mesh ball = test::sphere(1.0);
    VisibilityMaps maps;
    maps.face_px = 32;
    maps.nodes = {map_of(DVec3(0.0), 32, [](const DVec3& d) { return d.x < 0.0 ? 1.0 : 0.5; })};
    CHECK(share_seen(ball, maps, 0.01) == doctest::Approx(0.5).epsilon(0.05));
}

TEST_CASE("distances_between: a ball in a ball is as far as their radii differ") {
    const SurfaceDistances d = distances_between(test::sphere(0.5), test::sphere(0.4));
    CHECK(d.mean == doctest::Approx(0.1).epsilon(0.01));
    CHECK(d.hausdorff == doctest::Approx(0.1).epsilon(0.02));
}

TEST_CASE("look_from_nodes: a skeleton of another mesh is refused") {
    const Mesh ball = test::sphere(0.5);
    SkeletonGraph graph;
    graph.nodes.push_back({DVec3(0.0), 0.5, 3, 0.0});
    CHECK_THROWS_WITH_AS(maps_by_cpu(ball, graph), doctest::Contains("speaks of number 3"),
                         InputError);
}

TEST_CASE("rebuild_surface: maps without any surface are refused") {
    VisibilityMaps maps;
    maps.face_px = 4;
    maps.nodes = {map_of(DVec3(0.0), 4, [](const DVec3&) { return kInfinity; })};
    CHECK_THROWS_AS(rebuild_surface(maps, {}), InputError);
}
