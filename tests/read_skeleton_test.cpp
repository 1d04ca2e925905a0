#include <doctest/doctest.h>

#include "support/parse.h"
#include "zskel/io/skeleton_formats.h"

using namespace zskel;
using test::contains;
using test::Malformed;

namespace {

std::string error_of(std::string_view text, SkeletonFormat format) {
    try {
        parse_skeleton(text, format, "file");
    } catch (const InputError& error) {
        return error.what();
    }
    return "read without an error";
}

void check_errors(SkeletonFormat format, const std::vector<Malformed>& cases) {
    for (const Malformed& bad : cases) {
        const std::string error = error_of(bad.text, format);
        CHECK_MESSAGE(contains(error, bad.message), error << " lacks: " << bad.message);
        CHECK_MESSAGE(contains(error, "file"), error);
    }
}

}  // namespace

TEST_CASE("read_skeleton_json: errors name the element") {
    const auto ours = [](const std::string& nodes, const std::string& edges) {
        return R"({"format":"zskel-skeleton","version":1,"nodes":[)" + nodes + R"(],"edges":[)" +
               edges + "]}";
    };
    const std::string node = R"({"id":0,"position":[0,0,0],"radius":1})";
    check_errors(SkeletonFormat::Json,
                 {{"{", "no JSON"},
                  {"[]", "object"},
                  {"{}", "no member 'nodes'"},
                  {R"({"format":"other"})", "format: '\"other\"' is not"},
                  {R"({"format":"zskel-skeleton","version":2})", "version: '2'"},
                  {ours("", ""), "no nodes"},
                  {ours("7", ""), "nodes[0]: '7' is not an object"},
                  {ours(R"({"id":1})", ""), "nodes[0]: id"},
                  {ours(R"({"id":0,"position":[0,0],"radius":1})", ""), "position"},
                  {ours(R"({"id":0,"position":[0,0,"x"],"radius":1})", ""),
                   "nodes[0]: position[2]: '\"x\"'"},
                  {ours(R"({"id":0,"position":[0,0,1e999],"radius":1})", ""), "1e999"},
                  {ours(R"({"id":0,"position":[0,0,0],"radius":-1})", ""), "nodes[0]: radius -1"},
                  {ours(R"({"id":0,"position":[0,0,0]})", ""), "no member 'radius'"},
                  {ours(R"({"id":0,"position":[0,0,0],"radius":1,"solid":-1})", ""), "solid: '-1'"},
                  {ours(node, R"({"source":0,"target":1})"), "edges[0]: an edge to node 1"},
                  {ours(node, R"({"source":0,"target":0.5})"), "target: '0.5'"},
                  {ours(node, R"({"source":0,"target":18446744073709551615})"), "target"},
                  {ours(node, R"({"source":0,"target":0})"), "to itself"}});
}

TEST_CASE("read_skeleton_json: values that nest deeper than a stack are refused") {
    const std::string deep = std::string(200000, '[') + std::string(200000, ']');
    check_errors(SkeletonFormat::Json,
                 {{deep, "nest deeper"},
                  {R"({"nodes":[{"x":0,"y":0,"z":0,"id":)" + deep + "}]}", "nest deeper"},
                  {R"({"nodes":[],"links":)" + deep + R"(,"edges":)" + deep + "}", "nest deeper"}});
}

TEST_CASE("read_skeleton_json: node-link data of others") {
    const std::string nodes =
        R"("nodes":[{"id":"a","x":0,"y":0,"z":0},{"id":"b","x":1,"y":0,"z":0}])";
    const SkeletonFile file = parse_skeleton(
        "{" + nodes + R"(,"links":[{"source":"b","target":"a"}]})", SkeletonFormat::Json, "file");
    CHECK_FALSE(file.has_radii);
    REQUIRE(file.graph.edges.size() == 1);
    CHECK(file.graph.edges[0].source == 0);
    check_errors(
        SkeletonFormat::NodeLink,
        {{"{" + nodes + "}", "no member 'links'"},
         {"{" + nodes + R"(,"edges":[{"source":"a","target":"c"}]})", "target: '\"c\"'"},
         {"{" + nodes + R"(,"edges":[{"source":"a","target":"b"}],"links":[]})", "differ"},
         {"{" + nodes + R"(,"edges":[{"source":"a","target":"b"},{"source":"b","target":"a"}]})",
          "edges[1]: an edge that was there already"},
         {R"({"nodes":[{"id":1,"x":0,"y":0,"z":0},{"id":1,"x":0,"y":0,"z":0}],"links":[]})",
          "nodes[1]: id"}});
}

TEST_CASE("read_swc: samples in any order; errors name the line") {
    const SkeletonFile file = parse_skeleton("# by hand\n9 3 1 0 0 .5 4\r\n4 1 0 0 0 1 -1\n",
                                             SkeletonFormat::Swc, "file");
    REQUIRE(file.graph.edges.size() == 1);
    CHECK(file.graph.nodes[0].radius == 0.5);
    check_errors(SkeletonFormat::Swc,
                 {{"1 0 0 0 0 1\n", "file:1: expected parent"},
                  {"1 0 0 0 0 1 -1 9\n", "file:1: '9' after"},
                  {"1 0 0 0 x 1 -1\n", "'x'"},
                  {"1 0 0 0 0 -1 -1\n", "file:1: radius -1"},
                  {"1 0 0 0 0 1 -1\n1 0 0 0 0 1 -1\n", "file:2: a second sample"},
                  {"1 0 0 0 0 1 -1\n2 0 0 0 0 1 3\n", "file:2: no sample has the id 3"},
                  {"1 0 0 0 0 1 1\n", "to itself"},
                  {"1 0 0 0 0 1 2\n2 0 0 0 0 1 1\n", "file:2: an edge that was there"},
                  {"# cut 1 5\n1 0 0 0 0 1 -1\n", "file:1: no sample has the id 5"}});
}

TEST_CASE("read_obj_lines, read_polylines: errors name the line") {
    check_errors(SkeletonFormat::ObjLines, {{"v 0 0\n", "file:1:"},
                                            {"v 0 0 0\nl 1 2\n", "file:2: end '2'"},
                                            {"v 0 0 0\nl 1\n", "file:2: a line with one end"},
                                            {"v 0 0 0\nl 0 1\n", "end '0'"},
                                            {"v 0 0 0\nv 1 0 0\nl 1 -1\nl 1/1 2/2\n", "file:4:"},
                                            {"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "extract"},
                                            {"hello\n", "'hello'"}});
    check_errors(SkeletonFormat::Polylines, {{"2 0 0 0 1 0\n", "file:1: expected coordinate"},
                                             {"2 0 0 0 1 0 0 5\n", "'5' after"},
                                             {"0\n", "0 points"},
                                             {"2 0 0 0 0 0 0\n", "to itself"},
                                             {"99999999999 0 0 0\n", "expected coordinate"}});
}

TEST_CASE("read_ply_edges: errors name the line, meshes are refused") {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
        "property double z\n";
    const std::string edge = "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
    const SkeletonFile file = parse_skeleton(head + edge + "end_header\n0 0 0\n1 0 0\n1 0\n",
                                             SkeletonFormat::Ply, "file");
    CHECK_FALSE(file.has_radii);
    CHECK(file.graph.edges.size() == 1);
    check_errors(
        SkeletonFormat::Ply,
        {{head + "end_header\n0 0 0\n1 0 0\n", "no element 'edge'"},
         {head + edge + "end_header\n0 0 0\n1 0 0\n1 2\n", "file:13: an edge to node 2"},
         {head + edge + "end_header\n0 0 0\n1 0 0\n1 -1\n", "file:13:"},
         {head + edge + "end_header\n0 0 0\n1 0 0\n", "ends before"},
         {head + edge + "end_header\n0 0 0\n1 0 0\n1 0\n1 0\n", "more data"},
         {head + edge + "end_header\n0 0 0\n1 0 nan\n1 0\n", "finite"},
         {head + "element edge 1\nproperty int vertex1\nend_header\n0 0 0\n1 0 0\n", "'vertex2'"},
         {head +
              "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
          "extract"},
         {"ply\nformat binary_little_endian 1.0\nend_header\n", "binary"}});
}

TEST_CASE("read_graphml, read_vtp: errors name the element") {
    const std::string keys = R"(<key id="a" for="node" attr.name="x"/><key id="b" for="node"
        attr.name="y"/><key id="c" for="node" attr.name="z"/>)";
    const std::string node =
        R"(<node id="n"><data key="a">1</data><data key="b">2</data><data key="c">3</data></node>)";
    const auto graph = [&](const std::string& inside) {
        return "<graphml>" + keys + "<graph>" + inside + "</graph></graphml>";
    };
    check_errors(SkeletonFormat::GraphMl,
                 {{"<graphml>", "byte"},
                  {"<html/>", "no graphml"},
                  {"<graphml><graph/></graphml>", "no key for a node's x"},
                  {graph(""), "no nodes"},
                  {graph(R"(<node id="n"><data key="a">1</data></node>)"), "node 'n': y ''"},
                  {graph(node + node), "a second node 'n'"},
                  {graph(node + R"(<edge source="n" target="m"/>)"), "'m', which is no node"},
                  {graph(node + R"(<edge source="n" target="n"/>)"), "to itself"}});
    const auto vtp = [](const std::string& points, const std::string& lines) {
        return "<VTKFile><PolyData><Piece><Points><DataArray format=\"ascii\">" + points +
               "</DataArray></Points><Lines>" + lines + "</Lines></Piece></PolyData></VTKFile>";
    };
    const auto array = [](const std::string& name, const std::string& values) {
        return "<DataArray format=\"ascii\" Name=\"" + name + "\">" + values + "</DataArray>";
    };
    const std::string line = array("connectivity", "0 1");
    const SkeletonFile file = parse_skeleton(vtp("0 0 0 1 0 0", line + array("offsets", "2")),
                                             SkeletonFormat::Vtp, "file");
    CHECK_FALSE(file.has_radii);
    CHECK(file.graph.edges.size() == 1);
    check_errors(
        SkeletonFormat::Vtp,
        {{"<VTKFile/>", "no VTKFile with PolyData"},
         {vtp("0 0", ""), "2 coordinates"},
         {vtp("0 0 x", ""), "DataArray 'Points'"},
         {vtp("0 0 0 1 0 0", line), "without a DataArray offsets"},
         {vtp("0 0 0 1 0 0", line + array("offsets", "3")), "line 0 ends behind 3"},
         {vtp("0 0 0 1 0 0", array("connectivity", "0 1.5") + array("offsets", "2")), "1.5"},
         {vtp("0 0 0", line + array("offsets", "2")), "an edge to node 1"}});
}
