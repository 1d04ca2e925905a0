#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>

#include "support/odd_graph.h"
#include "support/parse.h"
#include "zskel/io/skeleton_formats.h"

using namespace zskel;
using test::contains;
using test::odd_graph;

namespace {

/// An edge by its ends' places, whichever comes first.
using PlacedEdge = std::pair<std::array<double, 3>, std::array<double, 3>>;

std::array<double, 3> place_of(const SkeletonGraph& graph, std::uint32_t n) {
    const DVec3& p = graph.nodes[n].position;
    return {p.x, p.y, p.z};
}

std::vector<PlacedEdge> placed_edges(const SkeletonGraph& graph) {
    std::vector<PlacedEdge> out;
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        out.push_back(std::minmax(place_of(graph, edge.source), place_of(graph, edge.target)));
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::map<std::array<double, 3>, double> placed_radii(const SkeletonGraph& graph) {
    std::map<std::array<double, 3>, double> out;
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n)
        out[place_of(graph, n)] = graph.nodes[n].radius;
    return out;
}

}  // namespace

TEST_CASE("skeleton formats: what is written is read back, digit for digit") {
    const SkeletonGraph graph = odd_graph();
    for (const SkeletonFormatInfo& info : skeleton_formats()) {
        if (!info.is_readable) continue;
        CAPTURE(info.name);
        const std::string text =
            write_skeleton(graph, info.format, {.tubes = false, .command = "a \"-->\" \n&<b>"});
        CHECK(text ==
              write_skeleton(graph, info.format, {.tubes = false, .command = "a \"-->\" \n&<b>"}));
        const SkeletonFile file = parse_skeleton(text, info.format, "file");
        CHECK(file.has_radii == info.keeps_radii);
        CHECK(placed_edges(file.graph) == placed_edges(graph));
        REQUIRE(file.graph.nodes.size() == graph.nodes.size());
        if (info.keeps_radii) CHECK(placed_radii(file.graph) == placed_radii(graph));
    }
}

TEST_CASE("skeleton formats: all but SWC and the lines keep volumes, solids and numbers") {
    const SkeletonGraph graph = odd_graph();
    for (const SkeletonFormat format :
         {SkeletonFormat::Json, SkeletonFormat::NodeLink, SkeletonFormat::GraphMl,
          SkeletonFormat::Ply, SkeletonFormat::Vtp}) {
        CAPTURE(info_of(format).name);
        const SkeletonGraph back =
            parse_skeleton(write_skeleton(graph, format), format, "file").graph;
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            CHECK(back.nodes[n].position == graph.nodes[n].position);
            CHECK(back.nodes[n].volume == graph.nodes[n].volume);
            CHECK(back.nodes[n].solid == graph.nodes[n].solid);
        }
        const bool is_json = format == SkeletonFormat::Json || format == SkeletonFormat::NodeLink;
        CHECK((back.vertex_node == graph.vertex_node) == is_json);
    }
}

TEST_CASE("skeleton formats: a graph without edges, and one without nodes") {
    SkeletonGraph lone;
    lone.nodes = {{{1, 2, 3}, 0.5, 0, 0}};
    for (const SkeletonFormatInfo& info : skeleton_formats()) {
        CAPTURE(info.name);
        const std::string text = write_skeleton(lone, info.format);
        const std::string none = write_skeleton({}, info.format);
        if (!info.is_readable) continue;
        const SkeletonGraph back = parse_skeleton(text, info.format, "file").graph;
        REQUIRE(back.nodes.size() == 1);
        CHECK(back.nodes[0].position == lone.nodes[0].position);
        CHECK(back.edges.empty());
        CHECK_THROWS_AS(parse_skeleton(none, info.format, "file"), InputError);
        CHECK_THROWS_AS(parse_skeleton("", info.format, "file"), InputError);
    }
}

TEST_CASE("skeleton formats: names and extensions") {
    for (const SkeletonFormatInfo& info : skeleton_formats()) {
        CHECK(parse_skeleton_format(info.name) == info.format);
        CHECK(&info_of(info.format) == &info);
        if (info.format == SkeletonFormat::NodeLink) continue;  // JSON's extension is ours
        CHECK(skeleton_format_of_path("a.b/x" + std::string(info.extension)) == info.format);
    }
    CHECK(skeleton_format_of_path("A.GLB") == SkeletonFormat::Glb);
    for (const char* path : {"-", "out", "/dev/stdout", ".", "a.swc/out"})
        CHECK(skeleton_format_of_path(path) == SkeletonFormat::Json);
    for (const char* path : {"a.txt", "a.stl", "a.json.gz", "a."})
        CHECK_THROWS_AS(skeleton_format_of_path(path), UsageError);
    CHECK_THROWS_AS(parse_skeleton_format("SWC"), UsageError);
    CHECK_THROWS_AS(
        write_skeleton(odd_graph(), SkeletonFormat::Swc, {.tubes = true, .command = {}}),
        UsageError);
    CHECK_THROWS_AS(parse_skeleton("x", SkeletonFormat::Glb, "file"), UsageError);
}

TEST_CASE("write_swc: cycles open at their longest edge, roots are the thickest") {
    const std::string text = write_skeleton(odd_graph(), SkeletonFormat::Swc);
    // Of the edges 1-2, 1-3 and 2-3 the longest is 1-3; of 5-6, 5-7 and 6-7 the last two are
    // equal, and the first of these is kept.
    CHECK(contains(text, "cycles: 2 opened"));
    CHECK(contains(text, "# cut 8 6\n# cut 1 4\n# id"));
    CHECK(contains(text, "component: 1 5 6\n"));
    CHECK(contains(text, "\n1 0 1 0 0 0.5 -1\n2 6 0.1"));
    CHECK(contains(text, "\n6 6 10.5 1 0 0.4 -1\n7 0 10 0 0 0.3 6\n"));
}

TEST_CASE("write_correspondence: a segment for each vertex that has a node") {
    const std::vector<DVec3> positions{{9, 9, 9}, {8, 8, 8}, {7, 7, 7}, {0.1, 0.2, 0.3}};
    CHECK(
        write_correspondence(odd_graph(), positions) ==
        "2 0.1 -0.3333333333333333 1e-17 9 9 9\n2 1e+20 5 -5 8 8 8\n2 2 0.001 0.25 0.1 0.2 0.3\n");
}
