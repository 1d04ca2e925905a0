#include "zskel/extract.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/extract.h"
#include "support/shapes.h"
#include "zskel/core/parallel.h"
#include "zskel/io/skeleton_formats.h"
#include "zskel/io/skeleton_json.h"

using namespace zskel;

namespace {

ExtractOptions paper() {
    ExtractOptions options;
    options.method = Method::Paper;
    return options;
}

}  // namespace

TEST_CASE(
    "extract_skeleton: a cube is one node at its centre, within one step (the paper's Figure 3)") {
    const ExtractResult result = test::extract(test::cube(), paper(), 16);
    REQUIRE(result.graph.nodes.size() == 1);
    CHECK(glm::length(result.graph.nodes[0].position) <= ExtractOptions{}.paper.steps.step_world);
    CHECK(result.graph.nodes[0].radius == doctest::Approx(0.5).epsilon(0.01));
    CHECK(result.graph.edges.empty());
    CHECK(result.statistics.seeds == 8);
    CHECK(result.warnings.empty());
}

TEST_CASE("extract_skeleton: a torus is a ring of nodes along its core") {
    const ExtractResult result = test::extract(test::torus(), paper());
    CHECK(result.graph.nodes.size() > 8);
    for (const SkeletonGraph::Node& node : result.graph.nodes) {
        const double ring = std::hypot(node.position.x, node.position.y);
        CHECK(ring == doctest::Approx(0.35).epsilon(0.05));
        CHECK(node.radius == doctest::Approx(0.12).epsilon(0.1));
    }
    CHECK(graph_topology(result.graph).components == 1);
    CHECK(graph_topology(result.graph).cycles >= 1);
}

TEST_CASE("extract_skeleton: answers in the model's own coordinates") {
    const Mesh here = test::cylinder(0.2, 1.0, 24, 17);
    const ExtractResult plain = test::extract(here, paper());
    // Powers of two, so that the world coordinates are the same to the last bit.
    const ExtractResult moved = test::extract(test::moved(here, {1024, -512, 64}, 8.0), paper());
    REQUIRE(plain.graph.nodes.size() == moved.graph.nodes.size());
    for (std::size_t i = 0; i < plain.graph.nodes.size(); ++i) {
        const DVec3 expected = plain.graph.nodes[i].position * 8.0 + DVec3(1024, -512, 64);
        CHECK(glm::distance(moved.graph.nodes[i].position, expected) < 1e-4);
        CHECK(moved.graph.nodes[i].radius ==
              doctest::Approx(plain.graph.nodes[i].radius * 8.0).epsilon(1e-4));
    }
}

TEST_CASE("extract_skeleton: every input vertex with a face has a node, others have none") {
    Mesh mesh = test::cylinder(0.2, 1.0, 16, 9);
    mesh.positions.emplace_back(9, 9, 9);
    const ExtractResult result = test::extract(mesh, paper());
    REQUIRE(result.graph.vertex_node.size() == mesh.positions.size());
    for (std::size_t v = 0; v + 1 < mesh.positions.size(); ++v) {
        CHECK(result.graph.vertex_node[v] < result.graph.nodes.size());
    }
    CHECK(result.graph.vertex_node.back() == kNone);
    CHECK_FALSE(result.warnings.empty());
}

TEST_CASE("extract_skeleton: the vertices of a tiny cavity have a node, and volumes add up") {
    const Mesh pore = test::moved(test::sphere(0.005, 1), {0.2, 0.1, 0.0});
    const ExtractResult result = test::extract(test::together(test::sphere(0.5), pore), {});
    REQUIRE(result.graph.nodes.size() == 1);
    CHECK(result.statistics.cavities == 1);
    CHECK(std::count(result.graph.vertex_node.begin(), result.graph.vertex_node.end(), 0u) ==
          static_cast<std::ptrdiff_t>(result.graph.vertex_node.size()));
    CHECK(result.graph.nodes[0].volume == doctest::Approx(0.5236).epsilon(0.02));
}

TEST_CASE("extract_skeleton: solids get skeletons of their own, and do not see each other") {
    const Mesh one = test::sphere(0.3, 2);
    const Mesh pair = test::together(one, test::moved(one, {0.62, 0, 0}));
    const ExtractResult result = test::extract(pair, paper());
    CHECK(result.statistics.solids == 2);
    REQUIRE(result.graph.nodes.size() == 2);
    CHECK(glm::length(result.graph.nodes[0].position) < 0.02);
    CHECK(glm::distance(result.graph.nodes[1].position, DVec3(0.62, 0, 0)) < 0.02);
    CHECK(graph_topology(result.graph).components == 2);
}

TEST_CASE("extract_skeleton: the same at one thread and at many") {
    const Mesh mesh = test::torus(0.35, 0.12, 24, 12);
    set_thread_limit(1);
    const ExtractResult one = test::extract(mesh, paper());
    set_thread_limit(0);
    const ExtractResult many = test::extract(mesh, paper());
    CHECK(write_skeleton(one.graph, SkeletonFormat::ObjLines) ==
          write_skeleton(many.graph, SkeletonFormat::ObjLines));
    CHECK(one.graph.vertex_node == many.graph.vertex_node);
}

TEST_CASE("extract_skeleton: progress is told, and can stop the work") {
    ExtractOptions options = paper();
    std::vector<std::string> stages;
    options.progress = [&](std::string_view stage, double) {
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
        return true;
    };
    test::extract(test::sphere(0.5, 2), options);
    CHECK(stages == std::vector<std::string>{"prepare", "hierarchy", "backend", "seeds", "settle",
                                             "cluster", "connect", "check"});
    options.progress = [](std::string_view stage, double) { return stage != "settle"; };
    CHECK_THROWS_AS(test::extract(test::sphere(0.5, 2), options), Cancelled);
}

TEST_CASE("skeleton_json: holds nodes, edges, vertex map, statistics and provenance") {
    const Mesh mesh = test::cylinder(0.2, 1.0, 16, 9);
    ExtractOptions options = paper();
    options.paper.steps.keep_paths = true;
    const ExtractResult result = test::extract(mesh, options);
    Provenance provenance;
    provenance.options = options;
    provenance.model = "a \"quoted\"\nname.obj";
    const auto json = nlohmann::json::parse(skeleton_json(result, provenance, {true, true, {}}));
    CHECK(json["format"] == "zskel-skeleton");
    CHECK(json["version"] == 1);
    CHECK(json["provenance"]["options"]["method"] == "paper");
    CHECK(json["nodes"].size() == result.graph.nodes.size());
    CHECK(json["nodes"][0]["position"][2] == result.graph.nodes[0].position.z);
    CHECK(json["edges"].size() == result.graph.edges.size());
    CHECK(json["vertex_node"].size() == mesh.positions.size());
    CHECK(json["statistics"]["evaluations"] == result.statistics.evaluations);
    CHECK(json["provenance"]["model"] == provenance.model);
    REQUIRE(json["seeds"].size() == result.seeds.size());
    CHECK(json["seeds"][3]["path"].size() == json["seeds"][3]["steps"].get<std::size_t>() + 1);
}

TEST_CASE("extract_skeleton: a sheet gets a few ways across, not one to every place at its rim") {
    const auto same = [](const DVec3& p) { return p; };
    Mesh plate = test::cube();
    for (int i = 0; i < 4; ++i) plate = test::subdivided(plate, same);
    for (DVec3& p : plate.positions) p.z *= 0.01;
    const ExtractResult result = test::extract(plate, {});
    CHECK(result.statistics.limbs > 0);
    CHECK(result.statistics.limbs <= 12);

    // A quarter of a tube's wall, much longer than wide: a way along it, on it.
    const Mesh tube = test::cylinder(0.1, 2.0, 24, 41);
    Mesh strip;
    strip.positions = tube.positions;
    for (const Triangle& t : tube.triangles) {
        const DVec3 middle =
            (tube.positions[t.x] + tube.positions[t.y] + tube.positions[t.z]) / 3.0;
        if (middle.x > 0.0 && middle.y > 0.0 && std::abs(middle.z) < 0.999)
            test::add_triangle(strip, t.x, t.y, t.z);
    }
    const ExtractResult along = test::extract(strip, {});
    CHECK(along.graph.nodes.size() < 200);
    double length = 0.0;
    for (const SkeletonGraph::Edge& edge : along.graph.edges)
        length += glm::distance(along.graph.nodes[edge.source].position,
                                along.graph.nodes[edge.target].position);
    CHECK(length == doctest::Approx(2.0).epsilon(0.15));
    for (const SkeletonGraph::Node& node : along.graph.nodes) {
        CHECK(std::hypot(node.position.x, node.position.y) < 0.11);
        CHECK(std::abs(node.position.z) < 1.01);
    }
}

TEST_CASE("extract_skeleton: nodes are evenly spread when that is asked for") {
    ExtractOptions options;
    options.newton.resample_model = 0.03;
    const ExtractResult result = test::extract(test::torus(), options);
    CHECK(result.check.failures.empty());
    CHECK(graph_topology(result.graph).cycles == 1);
    // A ring of radius 0.35, at most 0.03 apart, has 73.3 pieces of a circle.
    CHECK(result.graph.edges.size() == 74);
    for (const SkeletonGraph::Edge& edge : result.graph.edges) {
        const double length = glm::distance(result.graph.nodes[edge.source].position,
                                            result.graph.nodes[edge.target].position);
        CHECK(length == doctest::Approx(2.2 / 74.0).epsilon(0.05));
    }
    options.newton.resample_model = 1e-12;
    CHECK_THROWS_AS(test::extract(test::torus(), options), UsageError);
}

TEST_CASE("extract_skeleton: an active contour keeps nearer to a ring's core") {
    const auto off_core = [](const ExtractOptions& options) {
        double sum = 0.0;
        const ExtractResult result = test::extract(test::torus(), options);
        CHECK(result.check.failures.empty());
        for (const SkeletonGraph::Node& node : result.graph.nodes) {
            const double ring = std::hypot(node.position.x, node.position.y);
            sum += std::hypot(ring - 0.35, node.position.z);
        }
        return sum / static_cast<double>(result.graph.nodes.size());
    };
    ExtractOptions contour;
    contour.newton.refine = active_contour();
    CHECK(off_core(contour) < 0.7 * off_core({}));
    CHECK(off_core(contour) < 0.0006);  // its facets lie up to 0.0004 within the ring
}

TEST_CASE("write_skeleton: OBJ lines have a v for each node and an l for each edge") {
    SkeletonGraph graph;
    graph.nodes = {{{0.5, 0, -1e-9}, 1, 0}, {{1, 2, 3}, 1, 0}};
    graph.edges = {{0, 1}};
    CHECK(write_skeleton(graph, SkeletonFormat::ObjLines) ==
          "# zskel curve skeleton: v = node, l = edge\nv 0.5 0 -1e-09\nv 1 2 3\nl 1 2\n");
}

TEST_CASE("open_backend: options that make no sense together are usage errors") {
    BackendOptions options;
    options.kind = BackendKind::Gl;
    options.rays = 100;
    CHECK_THROWS_AS(open_backend(options), UsageError);
    options = {};
    options.kind = BackendKind::Ray;
    options.gpu = 0;
    CHECK_THROWS_AS(open_backend(options), UsageError);
    options = {};
    options.face_px = 2;
    CHECK_THROWS_AS(open_backend(options), UsageError);
    CHECK_THROWS_AS(parse_backend("vulkan"), UsageError);
}

TEST_CASE("extract_skeleton: a solid's skeleton is the same whatever else the model holds") {
    const SkeletonGraph alone = test::extract(test::torus()).graph;
    for (const double apart : {10.0, 1e6}) {
        const Mesh both =
            test::together(test::sphere(0.2, 2), test::moved(test::torus(), {apart, 0.0, 0.0}));
        SkeletonGraph part;
        for (const SkeletonGraph::Node& node : test::extract(both).graph.nodes) {
            if (node.solid == 1) part.nodes.push_back(node);
        }
        REQUIRE(part.nodes.size() == alone.nodes.size());
        for (std::size_t n = 0; n < part.nodes.size(); ++n) {
            const DVec3 back = part.nodes[n].position - DVec3(apart, 0.0, 0.0);
            CHECK(glm::distance(back, alone.nodes[n].position) < 1e-4);
        }
    }
}
