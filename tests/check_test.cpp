#include "zskel/mesh/check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "support/parse.h"
#include "support/shapes.h"
#include "zskel/io/report.h"

namespace zskel {
namespace {

Mesh mesh_of(std::vector<DVec3> positions, std::vector<Triangle> triangles) {
    Mesh mesh;
    mesh.name = "shape";
    mesh.face_count = triangles.size();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) mesh.face_of_triangle.push_back(t);
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    return mesh;
}

/// The unit cube, facing outward.
Mesh cube() {
    return test::parse(
        "OFF 8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
        "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n",
        MeshFormat::Off);
}

/// n by n vertices on a torus, facing outward.
Mesh torus(std::uint32_t n, double large, double small) {
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;
    const auto at = [n](std::uint32_t i, std::uint32_t j) { return (i % n) * n + j % n; };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const double u = 2.0 * std::numbers::pi * i / n;
            const double v = 2.0 * std::numbers::pi * j / n;
            const double r = large + small * std::cos(v);
            positions.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
            triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return mesh_of(std::move(positions), std::move(triangles));
}

/// Both meshes as one, the second one moved.
Mesh both(Mesh a, const Mesh& b, const DVec3& move) {
    const auto shift = static_cast<std::uint32_t>(a.positions.size());
    for (const DVec3& p : b.positions) a.positions.push_back(p + move);
    for (const Triangle& t : b.triangles) a.triangles.push_back(t + Triangle(shift));
    for (const std::uint32_t f : b.face_of_triangle) {
        a.face_of_triangle.push_back(f + static_cast<std::uint32_t>(a.face_count));
    }
    a.face_count += b.face_count;
    return a;
}

void turn_over(Triangle& t) {
    std::swap(t.y, t.z);
}

const Defect* find_defect(const MeshReport& report, std::string_view name) {
    const auto found = std::find_if(report.defects.begin(), report.defects.end(),
                                    [&](const Defect& d) { return d.name == name; });
    return found == report.defects.end() ? nullptr : &*found;
}

void check_defect(const MeshReport& report, std::string_view name, std::size_t count,
                  std::string_view example) {
    const Defect* defect = find_defect(report, name);
    CAPTURE(name);
    REQUIRE(defect != nullptr);
    CHECK(defect->count == count);
    CHECK(defect->example == example);
    CHECK_FALSE(defect->action.empty());
}

TEST_CASE("check_mesh: a cube is a proper solid of volume one") {
    const MeshReport report = check_mesh(cube());
    CHECK(report.vertices == 8);
    CHECK(report.faces == 6);
    CHECK(report.triangles == 12);
    REQUIRE(report.components.size() == 1);
    CHECK(report.components[0].is_closed);
    CHECK(report.components[0].is_oriented);
    CHECK(report.volume.value() == doctest::Approx(1.0).epsilon(1e-15));
    CHECK(report.genus == 0);
    CHECK(report.box.low == DVec3(0.0));
    CHECK(report.box.high == DVec3(1.0));
    CHECK(report.defects.empty());
    CHECK(report.hash != 0);
}

TEST_CASE("check_mesh: a torus has one handle and about Pappus's volume") {
    constexpr std::uint32_t sides = 200;
    const MeshReport report = check_mesh(torus(sides, 2.0, 0.5));
    CHECK(report.genus == 1);
    // An inscribed n-gon has less area than its circle by a factor of 1 - (2 pi / n)^2 / 6; twice.
    const double angle = 2.0 * std::numbers::pi / sides;
    const double exact = 2.0 * std::numbers::pi * std::numbers::pi * 2.0 * 0.25;
    CHECK(report.volume.value() < exact);
    CHECK(report.volume.value() > exact * (1.0 - 2.0 * angle * angle));
    CHECK(report.defects.empty());
}

TEST_CASE("check_mesh: far away, a volume keeps its digits") {
    Mesh mesh = cube();
    for (DVec3& p : mesh.positions) p += DVec3(1e6, -1e6, 1e6);
    CHECK(check_mesh(mesh).volume.value() == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("check_mesh: two components, each with its own numbers") {
    const MeshReport report = check_mesh(both(cube(), torus(20, 2.0, 0.5), DVec3(10, 0, 0)));
    REQUIRE(report.components.size() == 2);
    CHECK(report.components[0].genus == 0);
    CHECK(report.components[1].genus == 1);
    CHECK(report.components[1].triangles == 800);
    CHECK(report.components[1].box.low.x == doctest::Approx(7.5));
    CHECK(report.genus == 1);
    check_defect(report, "several_components", 2, "component 0");
}

TEST_CASE("check_mesh: separate triangles at equal places are one cube") {
    const Mesh whole = cube();
    Mesh soup = mesh_of({}, {});
    for (const Triangle& t : whole.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (int k = 0; k < 3; ++k) soup.positions.push_back(whole.positions[t[k]] * -1.0 * -1.0);
        soup.triangles.emplace_back(first, first + 1, first + 2);
    }
    const MeshReport report = check_mesh(soup);
    CHECK(report.components.size() == 1);
    CHECK(report.genus == 0);
    CHECK(report.coincident_vertices == 28);
    check_defect(report, "coincident_vertices", 28, "vertex 3");
}

TEST_CASE("check_mesh: defects are counted, with the first example") {
    Mesh mesh = cube();
    mesh.positions.emplace_back(9, 9, 9);
    mesh.triangles.emplace_back(0, 0, 1);
    mesh.triangles.push_back(mesh.triangles[0]);
    mesh.triangles.emplace_back(mesh.triangles[1].z, mesh.triangles[1].y, mesh.triangles[1].x);
    mesh.face_of_triangle.insert(mesh.face_of_triangle.end(), {6, 7, 8});
    mesh.face_count = 9;
    const MeshReport report = check_mesh(mesh);
    check_defect(report, "unreferenced_vertices", 1, "vertex 8");
    check_defect(report, "degenerate_triangles", 1, "face 6");
    check_defect(report, "duplicate_triangles", 2, "face 7");
    CHECK(report.defects.size() == 3);
    CHECK(report.volume.value() == doctest::Approx(1.0));
    CHECK(report.box.high == DVec3(1.0));
}

TEST_CASE("check_mesh: triangles without area are counted at any scale") {
    for (const double scale : {1e-150, 1.0, 1e150}) {
        Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0, 1, 0}}, {{0, 1, 3}, {0, 2, 1}});
        for (DVec3& p : mesh.positions) p *= scale;
        const MeshReport report = check_mesh(mesh);
        check_defect(report, "flat_triangles", 1, "face 1");
    }
}

TEST_CASE("check_mesh: an open cube has a boundary loop, no volume, and a warning to come") {
    Mesh mesh = cube();
    mesh.triangles.resize(10);
    const MeshReport report = check_mesh(mesh);
    CHECK(report.boundary_edges == 4);
    CHECK_FALSE(report.volume.has_value());
    CHECK(report.genus == 0);
    check_defect(report, "boundary_loops", 1, "loop at vertex 0");
    CHECK(test::contains(find_defect(report, "boundary_loops")->action, "closed with caps"));
}

TEST_CASE("check_mesh: turned faces and inside-out components") {
    Mesh mesh = cube();
    turn_over(mesh.triangles[5]);
    const MeshReport one = check_mesh(mesh);
    check_defect(one, "inconsistent_edges", 3, "edge 0-4");
    CHECK(one.volume.value() == doctest::Approx(1.0));

    mesh = cube();
    std::for_each(mesh.triangles.begin(), mesh.triangles.end(), turn_over);
    const MeshReport all = check_mesh(mesh);
    CHECK(all.volume.value() == doctest::Approx(-1.0));
    check_defect(all, "inside_out_components", 1, "component 0");
}

TEST_CASE("check_mesh: a fin on a cube is a non-manifold edge") {
    Mesh mesh = cube();
    mesh.positions.emplace_back(0.5, -1, 0);
    mesh.triangles.emplace_back(0, 1, 8);
    mesh.face_of_triangle.push_back(6);
    const MeshReport report = check_mesh(mesh);
    check_defect(report, "non_manifold_edges", 1, "edge 0-1");
    CHECK_FALSE(report.genus.has_value());
    CHECK(report.boundary_loops == 1);
}

TEST_CASE("check_mesh: faces that pass through others are counted") {
    const Mesh ball = test::sphere(0.5, 2);
    CHECK(check_mesh(ball).crossing_triangles == 0);
    const Mesh apart = test::together(ball, test::moved(ball, {2.0, 0.0, 0.0}));
    CHECK(check_mesh(apart).crossing_triangles == 0);
    const Mesh crossing = test::together(ball, test::moved(ball, {0.7, 0.01, 0.02}));
    const MeshReport report = check_mesh(crossing);
    CHECK(report.crossing_triangles > 10);
    CHECK(report.crossing_triangles < 100);
    CHECK(std::any_of(report.defects.begin(), report.defects.end(),
                      [](const Defect& defect) { return defect.name == "crossing_triangles"; }));
}

TEST_CASE("check_mesh: a Moebius strip is not orientable") {
    constexpr std::uint32_t quads = 30;
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < quads; ++i) {
        const double u = 2.0 * std::numbers::pi * i / quads;
        for (const double side : {-0.3, 0.3}) {
            const double r = 1.0 + side * std::cos(u / 2.0);
            positions.emplace_back(r * std::cos(u), r * std::sin(u), side * std::sin(u / 2.0));
        }
        const bool is_last = i + 1 == quads;
        const std::uint32_t low = is_last ? 1 : 2 * i + 2;
        const std::uint32_t high = is_last ? 0 : 2 * i + 3;
        triangles.emplace_back(2 * i, low, high);
        triangles.emplace_back(2 * i, high, 2 * i + 1);
    }
    const MeshReport report = check_mesh(mesh_of(positions, triangles));
    CHECK(report.components.size() == 1);
    CHECK_FALSE(report.components[0].is_orientable);
    CHECK_FALSE(report.genus.has_value());
    check_defect(report, "non_orientable_components", 1, "component 0");
}

TEST_CASE("check_mesh: a mesh without triangles reports nothing but its vertices") {
    const MeshReport report = check_mesh(mesh_of({{1, 2, 3}}, {}));
    CHECK(report.components.empty());
    CHECK_FALSE(report.genus.has_value());
    CHECK(report.box.low == DVec3(0.0));
}

TEST_CASE("to_json: holds every count, null for what is not known") {
    Mesh mesh = cube();
    mesh.triangles.resize(10);
    mesh.name = "caf\xE9 \"quoted\"";
    const auto json = nlohmann::json::parse(to_json(check_mesh(mesh)));
    CHECK(json["vertices"] == 8);
    CHECK(json["boundary_loops"] == 1);
    CHECK(json["volume"].is_null());
    CHECK(json["genus"] == 0);
    CHECK(json["box"]["high"] == nlohmann::json({1.0, 1.0, 1.0}));
    CHECK(json["components"][0]["is_closed"] == false);
    CHECK(json["defects"][0]["name"] == "boundary_loops");
    CHECK(json["hash"].get<std::string>().size() == 16);
}

TEST_CASE("to_text: says what there is and what extraction does about it") {
    const std::string good = to_text(check_mesh(cube()));
    CHECK(test::contains(good, "8 vertices, 6 faces, 12 triangles, 1 component\n"));
    CHECK(test::contains(good, "volume 1, genus 0"));
    CHECK(test::contains(good, "nothing to repair"));
    Mesh mesh = cube();
    mesh.triangles.resize(10);
    CHECK(test::contains(to_text(check_mesh(mesh)),
                         "boundary loops: 1, first loop at vertex 0; closed with caps"));
}

}  // namespace
}  // namespace zskel
