#include <doctest/doctest.h>

#include "support/parse.h"

namespace zskel {
namespace {

Mesh parse_off(std::string_view text) {
    return test::parse(text, MeshFormat::Off);
}

const std::string kVertices = "0 0 0\n1 0 0\n0 1 0\n";

TEST_CASE("read_off: vertices and faces keep their numbers and their order") {
    const Mesh mesh = parse_off("OFF\n4 2 0\n" + kVertices + "1 1 0\n3 2 0 1\n4 0 1 3 2\n");
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[3] == DVec3(1.0, 1.0, 0.0));
    CHECK(mesh.face_count == 2);
    CHECK(mesh.triangles[0] == Triangle(2, 0, 1));
    CHECK(mesh.face_of_triangle == std::vector<std::uint32_t>{0, 1, 1});
}

TEST_CASE("read_off: every variant gives the same triangle") {
    const Mesh plain = parse_off("OFF\n3 1 0\n" + kVertices + "3 0 1 2\n");
    for (const std::string text : {
             "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
             "OFF # c\n# c\n\n3 1 3 # c\n\n0 0 0 # c\n1 0 0\n\n# c\n0 1 0\n3 0 1 2 # c\n# end\n\n",
             "OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
             "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 0 1\n0 1 0 .5 .5 .5 1\n3 0 1 2\n",
             "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 nan\n3 0 1 2\n",
             "CNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1\n1 0 0 0 0 1 1 1 1\n0 1 0 0 0 1 1 1 1 1\n3 0 1 2\n",
             "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
             "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 17\n",
             "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n",
             "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.1 0.2 0.3 1.0\n",
         }) {
        CAPTURE(text);
        const Mesh mesh = parse_off(text);
        CHECK(mesh.positions == plain.positions);
        CHECK(mesh.triangles == plain.triangles);
        CHECK(mesh.warnings.empty());
    }
}

TEST_CASE("read_off: colours that the header does not announce are left out, with a warning") {
    const Mesh mesh = parse_off("OFF\n3 1 0\n0 0 0 9 9 9\n1 0 0 9 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n");
    CHECK(mesh.positions[1] == DVec3(1.0, 0.0, 0.0));
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(test::contains(mesh.warnings[0], "3 vertex lines"));
}

TEST_CASE("read_off: what is malformed is refused, with line and value") {
    const std::string one = "OFF\n3 1 0\n" + kVertices;
    const test::Malformed cases[] = {
        {"", "model: the file is empty"},
        {" \n", "model:2: '' begins the file; expected OFF"},
        {"OFF\n0 0 0\n", "the model has no faces"},
        {"3 1 0\n", "model:1: '3' begins the file; expected OFF"},
        {"OFFX\n3 1 0\n", "'OFFX' begins the file"},
        {"4OFF\n3 1 0\n", "'4OFF' has vertices of 4 or n dimensions"},
        {"nOFF\n3 1 0\n", "'nOFF' has vertices of 4 or n dimensions"},
        {"C4nOFF\n3 1 0\n", "'C4nOFF' has vertices of 4 or n dimensions"},
        {"OFF BINARY\n1234", "'OFF BINARY' is not read"},
        {"OFF\n", "the file ends before the counts"},
        {"OFF\n3\n", "model:2: expected number of faces, found the end of the line"},
        {"OFF\n3 1\n0 0 0\n", "model:2: expected number of edges"},
        {"OFF\n3 1 0 0\n" + kVertices + "3 0 1 2\n", "model:2: '0' after the counts"},
        {"OFF\n-3 1 0\n", "model:2: number of vertices -3; expected 0 to"},
        {"OFF\n3 -1 0\n", "model:2: number of faces -1"},
        {"OFF\n3.5 1 0\n", "number of vertices '3.5' is not a whole number"},
        {"OFF\n4000000000 1 0\n", "model:2: 4000000000 vertices and 1 faces declared"},
        {"OFF\n3 4000000000 0\n", "4000000000 faces declared"},
        {"OFF\n99999999999999999999 1 0\n", "'99999999999999999999' is not a whole number"},
        {"OFF\n8 12 0\n0 0 0\n1 0 0\n", "which take 144 bytes or more; the file has 13 left"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0 # padding\n",
         "model:6: the file ends after 0 of 1 faces"},
        {"OFF\n3 1 0\n0 0 0\n1.00000000000000000 0 0\n", "the file ends after 2 of 3 vertices"},
        {"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2 \n", "model:4: expected coordinate z"},
        {"OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n",
         "model:4: coordinate z 'inf' is not a finite"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "model:4: 1 numbers after x y z"},
        {"COFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "model:3: 0 numbers after x y z"},
        {"NOFF\n3 1 0\n0 0 0 1 1\n1 0 0\n0 1 0\n3 0 1 2\n", "model:3: 2 numbers after x y z"},
        {one + "2 0 1  \n", "model:6: face with 2 corners"},
        {one + "-3 0 1 2\n", "model:6: face with -3 corners"},
        {one + "4000000000 0 1 2\n", "model:6: face with 4000000000 corners; the file has"},
        {one + "4 0 1 2    \n", "model:6: expected vertex of a face, found the end of the line"},
        {one + "3 0 1 3\n", "model:6: face asks for vertex 3; expected 0 to 2"},
        {one + "3 0 1 -1\n", "model:6: face asks for vertex -1"},
        {one + "3 0 1 1.5\n", "model:6: vertex of a face '1.5' is not a whole number"},
        {one + "3 0 1 2 9 9\n", "model:6: 2 numbers after the 3 corners"},
        {one + "3 0 1 2 red\n", "model:6: face colour 'red' is not a number"},
        {one + "3 0 1 2\n3 0 1 2\n", "model:7: '3' after the last of 1 faces"},
    };
    for (const test::Malformed& bad : cases) {
        CAPTURE(bad.text);
        const std::string error = test::error_of(bad.text, MeshFormat::Off);
        CAPTURE(error);
        CHECK(test::contains(error, bad.message));
    }
}

}  // namespace
}  // namespace zskel
