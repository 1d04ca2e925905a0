#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <limits>

#include "support/parse.h"

namespace zskel {
namespace {

Mesh parse_stl(std::string_view text) {
    return test::parse(text, MeshFormat::Stl);
}

using Facet = std::array<std::array<float, 3>, 3>;

/// A tetrahedron, facing outward; its corners are 0, x, y and z in this order of first use.
const std::array<Facet, 4> kTetrahedron = {{{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                            {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                            {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                            {{{1, 0, 0}, {0, 1, 0}, {-0.0F, 0, 1}}}}};

std::string ascii_facet(const Facet& facet) {
    std::string text = "facet normal 0 0 nan\n outer loop\n";
    for (const auto& v : facet) text += fmt::format("  vertex {} {} {}\n", v[0], v[1], v[2]);
    return text + " endloop\nendfacet\n";
}

std::string ascii_tetrahedron() {
    std::string text = "solid a thing\n";
    for (const Facet& facet : kTetrahedron) text += ascii_facet(facet);
    return text + "endsolid a thing\n";
}

std::string binary_tetrahedron(std::string header = "made by a test") {
    header.resize(80, ' ');
    std::string bytes = header + test::bytes_of<std::uint32_t>(kTetrahedron.size());
    for (const Facet& facet : kTetrahedron) {
        for (int i = 0; i < 3; ++i) bytes += test::bytes_of(0.0F);
        for (const auto& v : facet) {
            for (const float value : v) bytes += test::bytes_of(value);
        }
        bytes += test::bytes_of<std::uint16_t>(0);
    }
    return bytes;
}

TEST_CASE("read_stl: equal corners become one vertex, numbered as first seen") {
    for (const std::string& text : {ascii_tetrahedron(), binary_tetrahedron()}) {
        const Mesh mesh = parse_stl(text);
        CHECK(mesh.positions == std::vector<DVec3>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}});
        CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 3}});
        CHECK(mesh.face_count == 4);
    }
}

TEST_CASE("read_stl: a binary header that begins with solid is still binary") {
    CHECK(parse_stl(binary_tetrahedron("solid facet normal")).triangles.size() == 4);
}

TEST_CASE("read_stl: keywords in capitals, several solids and odd line ends pass") {
    std::string text = ascii_tetrahedron();
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    CHECK(parse_stl(text).triangles.size() == 4);
    CHECK(parse_stl("\r\n" + ascii_tetrahedron() + "\n" + ascii_tetrahedron()).triangles.size() ==
          8);
    CHECK(parse_stl("solid\r\nfacet normal 0 0 1\r\nouter\r\nloop vertex 0 0 0 vertex\n1 0\n0\n"
                    "vertex 0 1 0 endloop endfacet endsolid")
              .triangles.size() == 1);
}

TEST_CASE("read_stl: a malformed ascii file is refused, with line and value") {
    const std::string head = "solid\nfacet normal 0 0 1\nouter loop\n";
    const std::string three = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
    const test::Malformed cases[] = {
        {"", "model: the file is empty"},
        {"solid\nendsolid\n", "the model has no faces"},
        {"solid", "model:1: expected facet or endsolid, found the end of the file"},
        {"solid\nfacet normal 0 0\n", "model:3: expected facet normal, found the end of the line"},
        {"solid\nfacet normal 0 0 z\n", "model:2: facet normal 'z' is not a number"},
        {"solid\nfacet 0 0 1\n", "model:2: expected normal, found '0'"},
        {head + "vertex 0 0 0\nvertex 1 0 0\nendloop\n",
         "model:6: expected vertex, found 'endloop'"},
        {head + three + "vertex 1 1 0\n", "model:7: expected endloop, found 'vertex'"},
        {head + "vertex 0 0 nan\n", "model:4: vertex coordinate 'nan' is not a finite number"},
        {head + "vertex 0 0 1e999\n", "model:4: vertex coordinate '1e999' is not a finite number"},
        {head + "vertex 0 0 1.0f\n", "model:4: vertex coordinate '1.0f' is not a number"},
        {head + three, "model:7: expected endloop, found the end of the file"},
        {head + three + "endloop\nendfacet\n",
         "expected facet or endsolid, found the end of the file"},
        {head + three + "endloop\nendfacet\nendsolid\nmore\n",
         "model:10: expected solid, found 'more'"},
        {"hello", "5 bytes that begin with 'hello'"},
    };
    for (const test::Malformed& bad : cases) {
        CAPTURE(bad.text);
        const std::string error = test::error_of(bad.text, MeshFormat::Stl);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

TEST_CASE("read_stl: a malformed binary file is refused, with byte and value") {
    const std::string good = binary_tetrahedron();
    std::string not_finite = good;
    not_finite.replace(84 + 12 + 4, 4, test::bytes_of(std::numeric_limits<float>::infinity()));
    std::string too_many = good;
    too_many.replace(80, 4, test::bytes_of<std::uint32_t>(4000000000U));
    const test::Malformed cases[] = {
        {good.substr(0, 50), "50 bytes that begin with 'made by '"},
        {good.substr(0, 82), "model: byte 80: the file ends within the number of facets"},
        {good.substr(0, 84), "model: byte 80: 4 facets declared, which make a file of 284 bytes; "},
        {good.substr(0, good.size() - 1), "this one has 283"},
        {good + " ", "this one has 285"},
        {too_many, "model: byte 80: 4000000000 facets declared"},
        {not_finite, "model: byte 100: vertex coordinate inf is not a finite number"},
        {std::string(84, '\0'), "the model has no faces"},
    };
    for (const test::Malformed& bad : cases) {
        const std::string error = test::error_of(bad.text, MeshFormat::Stl);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

}  // namespace
}  // namespace zskel
