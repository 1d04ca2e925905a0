// What is mended of meshes that bound no solid as they are.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include "support/box.h"
#include "support/extract.h"
#include "support/parse.h"
#include "support/shapes.h"
#include "support/voxels.h"
#include "zskel/core/error.h"
#include "zskel/join.h"
#include "zskel/mesh/outlook.h"
#include "zskel/mesh/solid.h"
#include "zskel/mesh/topology.h"
#include "zskel/mesh/winding.h"
#include "zskel/mesh/winding_tree.h"

using namespace zskel;

namespace {

constexpr RepairOptions kWithCaps{.has_caps = true};

PreparedSurface prepared(const Mesh& mesh, const RepairOptions& options = kWithCaps) {
    return prepare_surface(mesh, WorldSize::UnitCube, options);
}

std::size_t count_of(const std::vector<Repair>& repairs, std::string_view piece) {
    for (const Repair& repair : repairs) {
        if (repair.what.find(piece) != std::string_view::npos) return repair.count;
    }
    return 0;
}

bool all_closed(const PreparedSurface& surface) {
    const auto& closed = surface.component_closed;
    return std::find(closed.begin(), closed.end(), false) == closed.end();
}

double volume_of(const std::vector<DVec3>& positions, const std::vector<Triangle>& triangles) {
    double volume = 0.0;
    for (const Triangle& t : triangles)
        volume += glm::dot(positions[t.x], glm::cross(positions[t.y], positions[t.z])) / 6.0;
    return volume;
}

double volume_of(const Surface& surface) {
    std::vector<DVec3> positions;
    for (const Vec3& p : surface.positions) positions.emplace_back(p);
    return volume_of(positions, surface.triangles);
}

// Without the triangles for which `gone` is true of all corners.
template <typename Gone>
Mesh without(const Mesh& mesh, Gone gone) {
    Mesh out;
    out.name = mesh.name;
    out.positions = mesh.positions;
    for (const Triangle& t : mesh.triangles) {
        const bool is_gone =
            gone(mesh.positions[t.x]) && gone(mesh.positions[t.y]) && gone(mesh.positions[t.z]);
        if (!is_gone) test::add_triangle(out, t.x, t.y, t.z);
    }
    return out;
}

// The wall of a tube along z, without ends.
Mesh open_tube(double radius, double length) {
    return without(test::cylinder(radius, length, 24, 33),
                   [&](const DVec3& p) { return std::abs(std::abs(p.z) - 0.5 * length) < 1e-9; });
}

}  // namespace

TEST_CASE(
    "repair: every triangle on its own, moved by less than the tolerance, is one solid again") {
    const Mesh whole = test::torus();
    std::mt19937 random(3);
    const auto noise = [&] { return 2e-6 * (static_cast<double>(random() % 1000) / 1000.0 - 0.5); };
    Mesh soup;
    for (const Triangle& t : whole.triangles) {
        const auto n = static_cast<std::uint32_t>(soup.positions.size());
        for (int k = 0; k < 3; ++k)
            soup.positions.push_back(whole.positions[t[k]] + DVec3(noise(), noise(), noise()));
        test::add_triangle(soup, n, n + 1, n + 2);
    }
    const PreparedSurface surface = prepared(soup);
    CHECK(surface.surface.positions.size() == whole.positions.size());
    CHECK(surface.component_count == 1);
    CHECK(all_closed(surface));
    CHECK(count_of(surface.repairs, "welded within the tolerance") ==
          3 * whole.triangles.size() - whole.positions.size());
    const PreparedSurface apart =
        prepared(soup, {.weld_tolerance_diagonals = 0.0, .has_caps = true});
    CHECK(apart.component_count == whole.triangles.size());
}

TEST_CASE("repair: a vertex on the inside of an edge splits it") {
    Mesh mesh = test::cube();
    // The first triangle is cut at the middle of its first edge; its neighbour is not.
    const Triangle t = mesh.triangles[0];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(0.5 * (mesh.positions[t.x] + mesh.positions[t.y]));
    mesh.triangles[0] = {t.x, middle, t.z};
    test::add_triangle(mesh, middle, t.y, t.z);
    const PreparedSurface surface = prepared(mesh);
    CHECK(count_of(surface.repairs, "T-junctions") == 1);
    CHECK(all_closed(surface));
    CHECK(surface.surface.triangles.size() == 14);
    CHECK(surface.openings.empty());
    CHECK(volume_of(surface.surface) == doctest::Approx(1.0));
}

TEST_CASE("repair: fins are left out, and so is a wall between two rooms") {
    Mesh fin = test::finer(test::cube());
    const Triangle t = fin.triangles[40];
    fin.positions.push_back(fin.positions[t.x] * 1.1);
    test::add_triangle(fin, t.x, t.y, static_cast<std::uint32_t>(fin.positions.size() - 1));
    const PreparedSurface without_fin = prepared(fin);
    CHECK(count_of(without_fin.repairs, "hang loose") == 1);
    CHECK(all_closed(without_fin));
    CHECK(without_fin.surface_vertex.back() == kNone);

    // Two boxes that share a side, which is there once.
    Mesh rooms = test::make_box({0, 0, 0}, {1, 1, 1});
    const Mesh next = test::make_box({1, 0, 0}, {2, 1, 1});
    rooms = test::together(rooms, without(next, [](const DVec3& p) { return p.x == 1.0; }));
    const PreparedSurface one = prepared(rooms);
    CHECK(count_of(one.repairs, "part what is one inside") == 2);
    CHECK(one.component_count == 1);
    CHECK(all_closed(one));
    CHECK(volume_of(one.surface) * std::pow(2.0, 3) == doctest::Approx(2.0));
}

TEST_CASE("repair: two boxes that touch along an edge are two solids") {
    const Mesh boxes =
        test::together(test::make_box({0, 0, 0}, {1, 1, 1}), test::make_box({1, 1, 0}, {2, 2, 1}));
    const PreparedSurface surface = prepared(boxes);
    CHECK(count_of(surface.repairs, "non-manifold edges parted") == 1);
    CHECK(surface.component_count == 2);
    CHECK(all_closed(surface));
    CHECK(surface.input_vertex.size() == surface.surface.positions.size());
    for (std::size_t v = 0; v < surface.input_vertex.size(); ++v) {
        const Vec3 there =
            surface.surface.world_from_model.to_world(boxes.positions[surface.input_vertex[v]]);
        CHECK(glm::distance(there, surface.surface.positions[v]) < 1e-6f);
    }
}

TEST_CASE("repair: a ring that only touches itself along an edge is none, however it is turned") {
    // Eight cubes round a hole, but for one corner: two of the others meet there in an edge.
    const Mesh block = test::voxels(
        {3, 3, 1}, 2, [](int x, int y, int) { return !(x == 1 && y == 1) && !(x == 0 && y == 0); });
    for (const double angle : {0.0, 0.2, 0.6, 1.3, 2.1}) {
        for (const double stretch : {0.4, 1.0, 2.5}) {
            for (const bool is_turned : {false, true}) {
                Mesh turned = block;
                for (DVec3& p : turned.positions) {
                    const double y = p.y * stretch;
                    p = {p.x * std::cos(angle) - y * std::sin(angle),
                         p.x * std::sin(angle) + y * std::cos(angle), p.z};
                }
                if (is_turned) turned = test::turned_inside_out(turned);
                const PreparedSurface surface = prepared(turned);
                CHECK(count_of(surface.repairs, "parted") == 2);
                CHECK(all_closed(surface));
                const Topology topology =
                    find_topology(surface.surface.positions.size(), surface.surface.triangles);
                REQUIRE(topology.components.size() == 1);
                CHECK(topology.components.front().genus == 0);
            }
        }
    }
}

TEST_CASE("repair: pillars that touch along one edge between the same two slabs part there") {
    const Mesh pillars =
        test::voxels({2, 2, 3}, 1, [](int x, int y, int z) { return z != 1 || x == y; });
    const PreparedSurface surface = prepared(pillars);
    CHECK(count_of(surface.repairs, "parted") == 1);
    CHECK(count_of(surface.repairs, "kept") == 0);
    CHECK(all_closed(surface));
    const Topology topology =
        find_topology(surface.surface.positions.size(), surface.surface.triangles);
    REQUIRE(topology.components.size() == 1);
    CHECK(topology.components.front().genus == 1);
    // Each pillar has a vertex of its own in the middle of the edge, where the input has none.
    REQUIRE(surface.put_in.size() == 2);
    for (const auto& [vertex, place] : surface.put_in) CHECK(place == DVec3(1.0, 1.0, 1.5));

    const ExtractResult result = test::extract(pillars);
    CHECK(result.check.expected_cycles == 1);
    CHECK(result.check.failures.empty());
}

TEST_CASE("repair: a fin that forks is left out whole") {
    Mesh fin = test::finer(test::cube());
    const Triangle t = fin.triangles[40];
    const DVec3 up = fin.positions[t.x] * 1.1;
    const auto add = [&](const DVec3& p) {
        fin.positions.push_back(p);
        return static_cast<std::uint32_t>(fin.positions.size() - 1);
    };
    const std::uint32_t a = add(up);
    const std::uint32_t b = add(fin.positions[t.y] * 1.1);
    const std::uint32_t left = add(up + DVec3(0.02, 0.01, 0.0));
    const std::uint32_t right = add(up - DVec3(0.02, 0.01, 0.0));
    test::add_triangle(fin, t.x, t.y, a);
    test::add_triangle(fin, t.y, b, a);
    test::add_triangle(fin, a, b, left);
    test::add_triangle(fin, a, b, right);
    const PreparedSurface surface = prepared(fin);
    CHECK(count_of(surface.repairs, "hang loose") == 4);
    CHECK(all_closed(surface));
}

TEST_CASE("caps: a hole is filled with the least area, whatever its outline") {
    // An L-shaped hole in a cube's top, by the corners of a 4 x 4 grid.
    Mesh mesh = without(test::finer(test::cube()), [](const DVec3& p) {
        return p.z > 0.49 && p.x <= 0.26 && p.y <= 0.26 && p.x >= -0.26 && p.y >= -0.26 &&
               (p.x <= 0.01 || p.y <= 0.01);
    });
    const PreparedSurface surface = prepared(mesh);
    REQUIRE(surface.openings.size() == 1);
    CHECK(all_closed(surface));
    CHECK(volume_of(surface.surface) == doctest::Approx(1.0));
    CHECK_FALSE(surface.openings[0].is_end);
    CHECK(surface.openings[0].center.z == doctest::Approx(0.5));
    const auto caps =
        std::count(surface.input_triangle.begin(), surface.input_triangle.end(), kNone);
    CHECK(caps > 0);
    const std::vector<Solid> solids = split_solids(surface);
    REQUIRE(solids.size() == 1);
    CHECK(solids[0].is_closed);
    CHECK(solids[0].caps.size() == static_cast<std::size_t>(caps));
    CHECK(solids[0].openings.size() == 1);
}

TEST_CASE("caps: a rim of many vertices is filled in parts; a sheet is left open") {
    const Mesh wide =
        without(test::cylinder(0.4, 1.0, 400, 5), [](const DVec3& p) { return p.z > 0.49; });
    const PreparedSurface surface = prepared(wide);
    REQUIRE(surface.openings.size() == 1);
    CHECK(all_closed(surface));
    CHECK(surface.openings[0].is_end);
    CHECK(surface.openings[0].radius == doctest::Approx(0.4).epsilon(0.001));

    const Mesh sheet =
        without(test::finer(test::cube()), [](const DVec3& p) { return p.z < 0.49; });
    Mesh only_top;
    only_top.positions = sheet.positions;
    for (const Triangle& t : sheet.triangles) {
        const auto is_top = [&](std::uint32_t v) { return sheet.positions[v].z > 0.49; };
        if (is_top(t.x) && is_top(t.y) && is_top(t.z)) test::add_triangle(only_top, t.x, t.y, t.z);
    }
    const PreparedSurface flat = prepared(only_top);
    CHECK(flat.openings.empty());
    CHECK_FALSE(all_closed(flat));
    CHECK(count_of(flat.repairs, "sheets left open") == 1);
}

TEST_CASE("caps: an open tube has its whole axis, its ends marked, with the wall's radius") {
    const double radius = 0.1;
    const ExtractResult result = test::extract(open_tube(radius, 1.0));
    CHECK(result.statistics.openings == 2);
    CHECK(result.statistics.open_ends == 2);
    CHECK(result.check.failures.empty());
    double low = 1.0;
    double high = -1.0;
    for (const SkeletonGraph::Node& node : result.graph.nodes) {
        low = std::min(low, node.position.z);
        high = std::max(high, node.position.z);
        CHECK(std::hypot(node.position.x, node.position.y) < 0.1 * radius);
        CHECK(node.radius == doctest::Approx(radius).epsilon(0.12));
        CHECK(node.is_open_end == (std::abs(std::abs(node.position.z) - 0.5) < 1e-3));
    }
    CHECK(low == doctest::Approx(-0.5).epsilon(1e-3));
    CHECK(high == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(result.surface.triangles.size() == 2 * 24 * 32);  // no caps
}

TEST_CASE("repairs: are refused where none are allowed") {
    ExtractOptions options;
    options.repair.is_allowed = false;
    CHECK_THROWS_AS(test::extract(open_tube(0.1, 1.0), options), InputError);
    CHECK_NOTHROW(test::extract(test::cube(), options));
}

TEST_CASE("look_out: a bowl sees more of the outside from its outer side") {
    const Mesh bowl = without(test::sphere(0.5, 3), [](const DVec3& p) { return p.z > 0.2; });
    std::vector<Repair> repairs;
    const WeldedMesh welded = weld_equal(bowl, repairs);
    const std::vector<std::uint32_t> group(welded.triangles.size(), 0);
    const Outlook view = look_out(welded, group, 1)[0];
    CHECK(view.front > 0.99);
    CHECK(view.back < 0.5);
}

TEST_CASE("WindingTree: near the exact number, inside, outside and near the surface") {
    const PreparedSurface surface = prepared(test::torus());
    const WindingTree tree(surface.surface.positions, surface.surface.triangles);
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        const auto x = [&] { return static_cast<double>(random() % 2000) / 1000.0 - 1.0; };
        const DVec3 p(x(), x(), 0.4 * x());
        const double exact =
            winding_number(surface.surface.positions, surface.surface.triangles, p);
        CHECK(std::abs(tree.at(p) - exact) < 0.05);
    }
}

TEST_CASE("join_parts: balls that overlap are one, with every vertex on it") {
    const Mesh balls =
        test::together(test::sphere(0.5, 3), test::moved(test::sphere(0.5, 3), {0.6, 0, 0}));
    const JoinedMesh joined = join_parts(balls, {}, {});
    const Topology topology = find_topology(joined.mesh.positions.size(), joined.mesh.triangles);
    REQUIRE(topology.components.size() == 1);
    CHECK(topology.components[0].is_closed);
    CHECK(topology.components[0].genus == 0);
    // Two balls less the lens that they share.
    const double pi = 3.14159265358979;
    const double lens = pi * std::pow(1.0 - 0.6, 2) * (0.6 * 0.6 + 4.0 * 0.5 * 0.6) / (12.0 * 0.6);
    const double expected = 2.0 * 4.0 / 3.0 * pi * 0.125 - lens;
    CHECK(volume_of(joined.mesh.positions, joined.mesh.triangles) ==
          doctest::Approx(expected).epsilon(0.03));
    ExtractOptions options;
    options.join = JoinOptions{};
    const ExtractResult result = test::extract(balls, options);
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(result.graph.vertex_node.size() == balls.positions.size());
    for (const std::uint32_t node : result.graph.vertex_node)
        CHECK(node < result.graph.nodes.size());
}

TEST_CASE("join_parts: where boxes abut or touch there is neither a void nor a cycle") {
    ExtractOptions options;
    options.join = JoinOptions{};
    for (const double gap : {0.0, 1e-3}) {
        const Mesh boxes = test::together(test::make_box({0, 0, 0}, {1, 1, 1}),
                                          test::make_box({1 + gap, 0.2, 0.3}, {2, 0.9, 0.8}));
        const ExtractResult result = test::extract(boxes, options);
        CHECK(result.statistics.cavities == 0);
        CHECK(result.check.components == 1);
        CHECK(result.check.cycles == 0);
    }
    const Mesh edge =
        test::together(test::make_box({0, 0, 0}, {1, 1, 1}), test::make_box({1, 1, 0}, {2, 2, 1}));
    CHECK(test::extract(edge, options).check.cycles == 0);
}

TEST_CASE("join_parts: a part thinner than a voxel is lost, and said to be") {
    const Mesh rod = test::together(test::make_box({0, 0, 0}, {1, 1, 1}),
                                    test::make_box({0.499, 0.499, 0.5}, {0.501, 0.501, 4.5}));
    const JoinedMesh joined = join_parts(rod, {}, {});
    CHECK(count_of(joined.repairs, "vertices lost") == 4);
    const JoinedMesh finer = join_parts(test::sphere(0.5, 2), {}, {});
    CHECK(count_of(finer.repairs, "vertices lost") == 0);
}

TEST_CASE("repair: quads given from both sides are duplicates, wherever they begin") {
    std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 3\nv 1 0 3\nv 1 1 3\nv 0 1 3\n";
    const int sides[6][4] = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5},
                             {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
    for (const auto& s : sides) {
        obj += fmt::format("f {} {} {} {}\n", s[0], s[1], s[2], s[3]);
        obj += fmt::format("f {} {} {} {}\n", s[3], s[2], s[1], s[0]);
    }
    const PreparedSurface prepared = prepare_surface(test::parse(obj, MeshFormat::Obj));
    CHECK(prepared.surface.triangles.size() == 12);
    const std::vector<Solid> solids = split_solids(prepared);
    REQUIRE(solids.size() == 1);
    CHECK(solids[0].is_closed);
}
