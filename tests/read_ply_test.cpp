#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <limits>

#include "support/parse.h"

namespace zskel {
namespace {

Mesh parse_ply(std::string_view text) {
    return test::parse(text, MeshFormat::Ply);
}

const std::string kTriangleHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kTriangle = kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// A pyramid over a square, with extra elements and properties, in any encoding.
std::string pyramid(std::string_view format, std::string_view line_end = "\n") {
    std::string header = fmt::format(
        "ply\nformat {} 1.0\ncomment made by a test\nobj_info nothing\n"
        "element camera 1\nproperty list ushort double views\nproperty char id\n"
        "element vertex 5\nproperty double x\nproperty uchar red\nproperty float y\nproperty short "
        "z\n"
        "property list uchar float weights\n"
        "element face 5\nproperty uint flags\nproperty list uint8 uint16 vertex_index\n"
        "element nothing 0\nproperty int a\nend_header\n",
        format);
    for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos;
         at += line_end.size()) {
        header.replace(at, 1, line_end);
    }
    return header;
}

struct Vertex {
    double x;
    float y;
    std::int16_t z;
};
const std::array<Vertex, 5> kCorners = {
    {{-1.5, -1, 0}, {1.5, -1, 0}, {1.5, 1, 0}, {-1.5, 1, 0}, {0.25, 0.125F, -300}}};
const std::vector<std::vector<std::uint16_t>> kFaces = {
    {0, 1, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};

std::string ascii_pyramid() {
    std::string text = pyramid("ascii") + "2 0.5 nan -3\n";
    for (const Vertex& v : kCorners) text += fmt::format("{} 255 {} {} 1 nan\n", v.x, v.y, v.z);
    for (const auto& face : kFaces) {
        text += fmt::format("4000000000 {}", face.size());
        for (const auto index : face) text += fmt::format(" {}", index);
        text += '\n';
    }
    return text;
}

std::string binary_pyramid(std::endian order, std::string_view line_end = "\n") {
    const bool is_little = order == std::endian::little;
    std::string text = pyramid(is_little ? "binary_little_endian" : "binary_big_endian", line_end);
    const auto put = [&](auto value) { text += test::bytes_of(value, order); };
    put(std::uint16_t{2});
    put(0.5);
    put(std::numeric_limits<double>::quiet_NaN());
    put(std::int8_t{-3});
    for (const Vertex& v : kCorners) {
        put(v.x);
        put(std::uint8_t{255});
        put(v.y);
        put(v.z);
        put(std::uint8_t{1});
        put(1.0F);
    }
    for (const auto& face : kFaces) {
        put(4000000000U);
        put(static_cast<std::uint8_t>(face.size()));
        for (const auto index : face) put(index);
    }
    return text;
}

TEST_CASE("read_ply: the three encodings give the same mesh") {
    const Mesh ascii = parse_ply(ascii_pyramid());
    REQUIRE(ascii.positions.size() == 5);
    CHECK(ascii.positions[4] == DVec3(0.25, 0.125, -300.0));
    CHECK(ascii.face_count == 5);
    CHECK(ascii.triangles.size() == 6);
    for (const auto order : {std::endian::little, std::endian::big}) {
        const Mesh binary = parse_ply(binary_pyramid(order));
        CHECK(binary.positions == ascii.positions);
        CHECK(binary.triangles == ascii.triangles);
        CHECK(binary.face_of_triangle == ascii.face_of_triangle);
    }
}

TEST_CASE("read_ply: the header may end its lines with LF, CRLF or CR") {
    for (const std::string_view line_end : {"\n", "\r\n", "\r"}) {
        CHECK(parse_ply(binary_pyramid(std::endian::little, line_end)).triangles.size() == 6);
    }
}

TEST_CASE("read_ply: binary data that begins like a line end is data") {
    std::string text =
        "ply\rformat binary_little_endian 1.0\relement odd 1\rproperty uchar a\relement vertex 3\r"
        "property char x\rproperty char y\rproperty char z\relement face 1\r"
        "property list uchar uchar vertex_indices\rend_header\r";
    text += std::string("\n\0\0\0\1\0\0\0\1\0\3\0\1\2", 14);
    CHECK(parse_ply(text).positions[1] == DVec3(1.0, 0.0, 0.0));
}

TEST_CASE("read_ply: faces may come before vertices") {
    const Mesh mesh = parse_ply(
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        "3 2 1 0\n\n0 0 0\n1 0 0\n0 1 0");
    CHECK(mesh.triangles[0] == Triangle(2, 1, 0));
}

TEST_CASE("read_ply: a malformed header is refused, with line and value") {
    const auto with = [](std::string_view from, std::string_view to) {
        return replaced(kTriangle, from, to);
    };
    const test::Malformed cases[] = {
        {"", "model: the file is empty"},
        {"plx\n", "model:1: 'plx' begins the file; expected ply"},
        {"ply\n", "the file ends within the header; expected end_header"},
        {"ply\nend_header\n", "the header ends without a line 'format'"},
        {with("ascii", "utf8"), "model:2: format 'utf8'; expected ascii"},
        {with("ascii 1.0", "ascii 2.0"), "model:2: version '2.0'; expected 1.0"},
        {with("format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n"),
         "a second line 'format'"},
        {with("element vertex 3", "element vertex -3"), "model:3: -3 of element 'vertex' declared"},
        {with("element vertex 3", "element vertex"), "model:3: expected number of elements"},
        {with("element vertex 3", "element vertex 3x"), "'3x' is not a whole number"},
        {with("element vertex 3", "element vertex 3 4"), "model:3: '4' after element"},
        {with("element vertex 3", "element vertex 4294967295"), "4294967295 of element 'vertex'"},
        {with("element vertex 3", "element vertex 4000000000"),
         "4000000000 of element 'vertex' declared, which take 6 bytes or more each; the file has"},
        {with("element face 1", "element face 5"),
         "5 of element 'face' declared, which take 8 bytes"},
        {with("element face", "element vertex"), "element 'vertex' is declared twice"},
        {with("element face", "element faces"), "the header has no element 'face'"},
        {with("element vertex", "element point"), "the header has no element 'vertex'"},
        {with("float y", "float x"), "model:5: property 'x' is declared twice"},
        {with("float y", "float w"), "element 'vertex' has no number 'y'"},
        {with("property float y", "property list uchar float y"), "has no number 'y'"},
        {with("float y", "real y"), "model:5: 'real' is no type of PLY"},
        {with("float y", "int64 y"), "model:5: 'int64' is no type of PLY"},
        {with("float y", "float"), "model:5: property without a name"},
        {with("list uchar int", "list float int"),
         "model:8: a list whose length is float or double"},
        {with("list uchar int", "list uchar float"), "needs one list 'vertex_indices'"},
        {with("list uchar int", "list list uchar int"), "'list' is no type of PLY"},
        {with("list uchar int", "int"), "needs one list 'vertex_indices'"},
        {with("vertex_indices", "corners"), "needs one list 'vertex_indices'"},
        {with("element vertex", "property float q\nelement vertex"), "a property before the first"},
        {with("element vertex", "elements vertex"), "model:3: 'elements' in the header"},
        {with("end_header", "end_header 5"), "'5' after end_header"},
    };
    for (const test::Malformed& bad : cases) {
        CAPTURE(bad.text);
        const std::string error = test::error_of(bad.text, MeshFormat::Ply);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

TEST_CASE("read_ply: malformed ascii data is refused, with line and value") {
    const test::Malformed cases[] = {
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n",
         "model:12: property 'z' of element 'vertex' is nan; expected a finite number"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1\n3 0 1 2  \n", "model:12: expected property 'z'"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0 0\n3 0 1 2\n", "model:12: '0' after vertex"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 zero\n3 0 1 2\n", "'zero' is not a number"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
         "face asks for vertex 3; expected 0 to 2"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "model:13: face asks for vertex -1"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n2 0 1    \n", "model:13: face with 2 corners"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n", "is -1; its type holds 0 to 255"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n300 0 1 2\n", "is 300; its type holds 0 to 255"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n200 0 1 2\n",
         "has a length of 200; the rest of the file holds 0 to 4"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n", "'2.5' is not a whole number"},
        {kTriangleHeader + "0 0 0\n1 0 0\n0 1 0.0000000000\n",
         "the file ends before the last face"},
        {kTriangle + "3 0 1 2\n", "model:14: more data after the last element"},
    };
    for (const test::Malformed& bad : cases) {
        CAPTURE(bad.text);
        const std::string error = test::error_of(bad.text, MeshFormat::Ply);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

TEST_CASE("read_ply: malformed binary data is refused, with byte and value") {
    const std::string good = binary_pyramid(std::endian::little);
    const std::size_t data = good.find("end_header\n") + 11;
    const std::size_t vertices = data + 2 + 16 + 1;
    const std::size_t faces = vertices + 5 * (8 + 1 + 4 + 2 + 1 + 4);
    const auto with = [&](std::size_t at, const std::string& bytes) {
        return std::string(good).replace(at, bytes.size(), bytes);
    };
    const double not_finite = std::numeric_limits<double>::infinity();
    const auto at = [](std::size_t offset) { return fmt::format("model: byte {}: ", offset); };
    const test::Malformed cases[] = {
        {with(data, test::bytes_of<std::uint16_t>(65535)),
         at(data) + "property 'views' of element "},
        {with(vertices, test::bytes_of(not_finite)),
         at(vertices) + "property 'x' of element 'vertex' "},
        {with(faces + 4, test::bytes_of<std::uint8_t>(2)), at(faces + 4) + "face with 2 corners"},
        {with(faces + 4, test::bytes_of<std::uint8_t>(255)),
         at(faces + 4) + "property 'vertex_index'"},
        {with(faces + 5, test::bytes_of<std::uint16_t>(5)),
         at(faces + 5) + "face asks for vertex 5"},
        {good.substr(0, good.size() - 1), "has a length of 3; the rest of the file holds 0 to 2"},
        {good.substr(0, data), "1 of element 'camera' declared"},
        {good + "\n", "more data after the last element"},
    };
    for (const test::Malformed& bad : cases) {
        const std::string error = test::error_of(bad.text, MeshFormat::Ply);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

}  // namespace
}  // namespace zskel
