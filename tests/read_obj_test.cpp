#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <random>

#include "support/parse.h"

namespace zskel {
namespace {

Mesh parse_obj(std::string_view text) {
    return test::parse(text, MeshFormat::Obj);
}

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_CASE("read_obj: vertices and faces keep their numbers and their order") {
    const Mesh mesh = parse_obj("v 0 0 0\nv 1 0 0\nv 0.5 -2.25e1 +3\nv 9 9 9\nf 3 1 2\n");
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[2] == DVec3(0.5, -22.5, 3.0));
    REQUIRE(mesh.triangles.size() == 1);
    CHECK(mesh.triangles[0] == Triangle(2, 0, 1));
    CHECK(mesh.face_count == 1);
    CHECK(mesh.hash != 0);
}

TEST_CASE("read_obj: a negative index counts back from the last vertex so far") {
    const Mesh mesh = parse_obj(kThree + "f -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n");
    CHECK(mesh.triangles[0] == Triangle(0, 1, 2));
    CHECK(mesh.triangles[1] == Triangle(3, 2, 1));
}

TEST_CASE("read_obj: a face may ask for a vertex that comes later") {
    CHECK(parse_obj("f 1 2 3\n" + kThree).triangles[0] == Triangle(0, 1, 2));
}

TEST_CASE("read_obj: corners may carry texture vertices and normals") {
    const std::string head = kThree + "vt 0 0\nvt 1 0 0\nvn 0 0 1\n";
    for (const std::string face : {"f 1/1 2/2 3/1", "f 1//1 2//1 3//-1", "f 1/1/1 2/-1/1 -1/2/1",
                                   "f 1/ 2/ 3/", "f 1// 2// 3//", "f 1/2/ 2/2/ 3/2/"}) {
        CAPTURE(face);
        CHECK(parse_obj(head + face).triangles[0] == Triangle(0, 1, 2));
    }
}

TEST_CASE("read_obj: polygons become triangles that know their face") {
    const Mesh mesh = parse_obj(kThree + "v 1 1 0\nf 1 2 4 3\nf 1 2 3\n");
    CHECK(mesh.face_count == 2);
    CHECK(mesh.face_of_triangle == std::vector<std::uint32_t>{0, 0, 1});
}

TEST_CASE("read_obj: comments, blank lines, odd line ends and long lines pass") {
    const std::string plain = kThree + "f 1 2 3\n";
    for (const std::string text :
         {"# c\r\n\r\nv 0 0 0\r\nv 1 0 0 # c\r\n  v 0 1 0\t\r\nf 1 2 3",
          "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
          "v 0 0 \\\n0\nv 1 0 0\nv \\\r\n 0 1 0\nf 1\\\n 2 \\\n\\\n 3\n",
          "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\n#f 9 9 9 \\\nf 1 2 3\\"}) {
        CAPTURE(text);
        const Mesh mesh = parse_obj(text);
        CHECK(mesh.positions == parse_obj(plain).positions);
        CHECK(mesh.triangles == parse_obj(plain).triangles);
    }
}

TEST_CASE("read_obj: weights and colours behind a position are left out") {
    const Mesh mesh = parse_obj("v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0 .5 .5 .5 1\nf 1 2 3\n");
    CHECK(mesh.positions == parse_obj(kThree + "f 1 2 3").positions);
}

TEST_CASE("read_obj: points and lines are left out and counted") {
    const Mesh mesh = parse_obj("o a\ng b\ns off\nusemtl m\n" + kThree + "p 1\nl 1 2\nf 1 2 3\n");
    CHECK(mesh.triangles.size() == 1);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(test::contains(mesh.warnings[0], "2 points"));
}

TEST_CASE("read_obj: a number too small for a double is zero") {
    CHECK(parse_obj("v 1e-999 -1e-5000 5e-324\nv 1 0 0\nv 0 1 0\nf 1 2 3").positions[0] ==
          DVec3(0.0, 0.0, 5e-324));
}

TEST_CASE("read_obj: numbers of any length become the nearest double") {
    std::mt19937_64 random(5);
    for (int round = 0; round < 5000; ++round) {
        std::string text = random() % 2 == 0 ? "-" : "";
        text += std::to_string(random()).substr(0, 1 + random() % 19) + ".";
        text += std::to_string(random()).substr(0, random() % 19);
        if (random() % 4 == 0) text += fmt::format("e{}", static_cast<int>(random() % 60) - 30);
        CAPTURE(text);
        const Mesh mesh = parse_obj("v " + text + " 0 0\nf 1 1 1");
        CHECK(mesh.positions[0].x == std::strtod(text.c_str(), nullptr));
    }
    for (const std::string text :
         {"9007199254740993", "0.1", ".5", "5.", "-0", "00000000000000000001",
          "0.00000000000000000000001", "123456789012345678901234567890",
          "179769313486231570000e288", "4.9e-324", "1E5", "+.25"}) {
        CAPTURE(text);
        const Mesh mesh = parse_obj("v " + text + " 0 0\nf 1 1 1");
        CHECK(mesh.positions[0].x == std::strtod(text.c_str(), nullptr));
    }
}

TEST_CASE("read_obj: a face that repeats a vertex stays a face") {
    CHECK(parse_obj(kThree + "f 1 1 2\n").triangles[0] == Triangle(0, 0, 1));
}

TEST_CASE("read_obj: what is malformed is refused, with line and value") {
    const test::Malformed cases[] = {
        {"", "model: the file is empty"},
        {"# nothing\n", "the model has no faces (0 vertices)"},
        {kThree, "the model has no faces (3 vertices)"},
        {"v 0 0\nf 1 1 1", "model:1: expected coordinate z, found the end of the line"},
        {"v 0 0 nan\n", "model:1: coordinate z 'nan' is not a finite number"},
        {"v 0 -inf 0\n", "model:1: coordinate y '-inf' is not a finite number"},
        {"v 1e999 0 0\n", "model:1: coordinate x '1e999' is not a finite number"},
        {"v 0 0 1.5x\n", "model:1: coordinate z '1.5x' is not a number"},
        {"v 0 1,5 0\n", "coordinate y '1,5' is not a number"},
        {"v 0 0x10 0\n", "coordinate y '0x10' is not a number"},
        {"v 0 +-1 0\n", "coordinate y '+-1' is not a number"},
        {"v 0 . 0\n", "coordinate y '.' is not a number"},
        {"v 0 1.2.3 0\n", "coordinate y '1.2.3' is not a number"},
        {"v 0 1e 0\n", "coordinate y '1e' is not a number"},
        {"v 0 --1 0\n", "coordinate y '--1' is not a number"},
        {"v 0 - 0\n", "coordinate y '-' is not a number"},
        {"v 0 0 0 1 1\n", "model:1: 5 numbers after 'v'"},
        {"v 0 0 0 1 1 1 1 1\n", "model:1: 8 numbers after 'v'"},
        {"v 0 0 0 red\n", "weight or colour 'red' is not a number"},
        {kThree + "f 1 2\n", "model:4: face with 2 corners; expected 3 or more"},
        {kThree + "f\n", "model:4: face with 0 corners"},
        {kThree + "\nf 1 2 0\n", "model:5: face corner '0'; expected 1 or more"},
        {kThree + "f 1 2 -4\n", "model:4: face corner '-4'; expected 1 or more, or -1 to -3"},
        {kThree + "f 1 2 3\nf 1 2 4\n", "model:5: face asks for vertex 4, but the file has only 3"},
        {kThree + "f 1 2 4294967297\n", "face corner '4294967297'"},
        {kThree + "f 1 2 99999999999999999999\n", "face corner '99999999999999999999'"},
        {kThree + "f 1 2 -9223372036854775808\n", "face corner '-9223372036854775808'"},
        {kThree + "f 1 2 3.0\n", "model:4: face corner '3.0'; expected v, v/vt, v//vn or v/vt/vn"},
        {kThree + "f 1 2 3/x\n", "face corner '3/x'"},
        {kThree + "f 1 2 /3\n", "face corner '/3'"},
        {kThree + "vt 0 0\nvn 0 0 1\nf 1 2 3/1/1/1\n", "model:6: face corner '3/1/1/1'"},
        {kThree + "f 1/1 2/1 3/1\n",
         "model:4: face asks for texture vertex 1, but the file has only 0"},
        {kThree + "f 1//2 2//1 3//1\nvn 0 0 1\n", "model:4: face asks for normal 2"},
        {kThree + "vn 0 0\n", "model:4: 2 numbers of a normal; expected 3 to 3"},
        {kThree + "vt\n", "model:4: 0 numbers of a texture vertex"},
        {"w 0 0 0\n", "model:1: 'w' is no statement of OBJ"},
        {std::string("v 0 0 0\0\n", 9), "coordinate z '0\\x00' is not a number"},
        {"OFF\n3 1 0\n", "model:1: 'OFF' is no statement of OBJ"},
        {"v 0 \\\n 0 \\\n x\n", "model:3: coordinate z 'x' is not a number"},
    };
    for (const test::Malformed& bad : cases) {
        CAPTURE(bad.text);
        const std::string error = test::error_of(bad.text, MeshFormat::Obj);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

}  // namespace
}  // namespace zskel
