#include "zskel/mesh/read_mesh.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "support/parse.h"
#include "zskel/mesh/check.h"

namespace zskel {
namespace {

namespace fs = std::filesystem;

const std::string kObj =
    "# c\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0 1\nvt 0 0\nvn 0 0 1\nf 1 2 \\\n 4 3\n"
    "f -1/1 -2/-1 -3/1\nf 1//1 2//1 3//1\n";
const std::string kOff =
    "OFF # c\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1.5e0 1 -0\n4 0 1 3 2 255 0 0\n3 2 1 0\n";
const std::string kAsciiPly =
    "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property double z\nproperty uchar red\nelement face 2\nproperty list uchar int "
    "vertex_indices\n"
    "end_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n1 1 0 1\n4 0 1 3 2\n3 2 1 0\n";
const std::string kAsciiStl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid a\n";

std::string binary_ply() {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
        "y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "property list uchar short tags\nend_header\n";
    for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) {
        bytes += test::bytes_of(value);
    }
    bytes += '\3';
    for (const int index : {0, 1, 2}) bytes += test::bytes_of(index);
    return bytes + '\1' + test::bytes_of<std::int16_t>(7);
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    bytes += test::bytes_of<std::uint32_t>(1);
    for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) {
        bytes += test::bytes_of(value);
    }
    return bytes + test::bytes_of<std::uint16_t>(0);
}

struct Seed {
    std::string extension;
    MeshFormat format;
    std::string bytes;
};

std::vector<Seed> seeds() {
    return {{".obj", MeshFormat::Obj, kObj},      {".off", MeshFormat::Off, kOff},
            {".ply", MeshFormat::Ply, kAsciiPly}, {".ply", MeshFormat::Ply, binary_ply()},
            {".stl", MeshFormat::Stl, kAsciiStl}, {".stl", MeshFormat::Stl, binary_stl()}};
}

/// A folder that goes away with the test.
class ScratchFolder {
  public:
    ScratchFolder()
        : path_(fs::temp_directory_path() / fmt::format("zskel-test-{}", std::random_device{}())) {
        fs::create_directory(path_);
    }
    ~ScratchFolder() { fs::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::string write(const std::string& name, const std::string& bytes) const {
        const fs::path file = path_ / name;
        std::ofstream(file, std::ios::binary) << bytes;
        return file.string();
    }
    std::string path() const { return path_.string(); }

  private:
    fs::path path_;
};

/// What every mesh that a reader returns must keep.
void check_promises(const Mesh& mesh) {
    CHECK(mesh.face_count > 0);
    CHECK(mesh.triangles.size() >= mesh.face_count);
    CHECK(mesh.face_of_triangle.size() == mesh.triangles.size());
    const auto is_in_range = [&](const Triangle& t) {
        return std::max({t.x, t.y, t.z}) < mesh.positions.size();
    };
    const auto is_finite = [](const DVec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    CHECK(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), is_in_range));
    CHECK(std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite));
}

TEST_CASE("read_mesh: the extension tells the format, in capitals too") {
    const ScratchFolder folder;
    for (const Seed& seed : seeds()) {
        CAPTURE(seed.extension);
        const Mesh mesh = read_mesh(folder.write("model" + seed.extension, seed.bytes));
        check_promises(mesh);
        CHECK(test::contains(mesh.name, "model" + seed.extension));
        CHECK(mesh.hash == test::parse(seed.bytes, seed.format).hash);
    }
    check_promises(read_mesh(folder.write("MODEL.OBJ", kObj)));
}

TEST_CASE("read_mesh: without a known extension the content tells the format") {
    const ScratchFolder folder;
    for (const Seed& seed : seeds()) {
        CAPTURE(seed.extension);
        check_promises(read_mesh(folder.write("model.tmp", seed.bytes)));
        check_promises(read_mesh(folder.write("model", seed.bytes)));
    }
}

TEST_CASE("read_mesh: what cannot be read is an input error that names the file") {
    const ScratchFolder folder;
    CHECK_THROWS_WITH_AS(read_mesh("no/such/file.obj"),
                         "no/such/file.obj: cannot be read: No such file or directory; "
                         "expected an OBJ, OFF, PLY, STL, BPT or JSON (surfaces) file",
                         InputError);
    CHECK_THROWS_AS(read_mesh(folder.path()), InputError);
    CHECK_THROWS_AS(read_mesh(folder.write("empty.obj", "")), InputError);
    CHECK_THROWS_AS(read_mesh(folder.write("empty", "")), InputError);
    CHECK_THROWS_AS(read_mesh(folder.write("notes.txt", "hello")), InputError);
    CHECK_THROWS_AS(read_mesh(folder.write("zero.bin", std::string(1000, '\0'))), InputError);
}

TEST_CASE("parse_mesh: every cut of a file is an input error or a mesh that keeps its promises") {
    for (const Seed& seed : seeds()) {
        for (std::size_t size = 0; size < seed.bytes.size(); ++size) {
            try {
                check_promises(test::parse(seed.bytes.substr(0, size), seed.format));
            } catch (const InputError& error) {
                CHECK(test::contains(error.what(), "model:"));
            }
        }
    }
}

/// What number parsers, line counters and header readers stumble over.
const std::vector<std::string> kPieces = {"-1",
                                          "0",
                                          "4294967295",
                                          "4294967296",
                                          "99999999999999999999",
                                          "nan",
                                          "1e999",
                                          "inf",
                                          "\n",
                                          "\r",
                                          "\\",
                                          "#",
                                          "/",
                                          " ",
                                          "\t",
                                          "+-",
                                          ".",
                                          "-",
                                          "f ",
                                          "v ",
                                          "\xFF\xFF\xFF\xFF",
                                          "property list uchar int a\n",
                                          "element face 3\n",
                                          "solid",
                                          "3 0 1 2\n"};

/// One change that a broken disk, a careless script or an attacker might make.
std::string mutated(std::string bytes, std::mt19937& random) {
    const auto below = [&random](std::size_t end) {
        return random() % std::max<std::size_t>(end, 1);
    };
    for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
        const std::size_t at = below(bytes.size());
        switch (below(6)) {
            case 0:
                bytes[at] = static_cast<char>(random());
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 2:
                bytes.erase(at, 1 + below(8));
                break;
            case 3:
                bytes.insert(at, kPieces[below(kPieces.size())]);
                break;
            case 4:
                bytes.insert(at, bytes.substr(below(bytes.size()), below(20)));
                break;
            default: {
                const std::string& piece = kPieces[below(kPieces.size())];
                bytes.replace(at, piece.size(), piece);
            }
        }
    }
    return bytes;
}

TEST_CASE("parse_mesh: changed bytes give an input error or a mesh that keeps its promises") {
    constexpr int rounds = 3000;
    std::mt19937 random(2003);
    for (const Seed& seed : seeds()) {
        int read = 0;
        for (int round = 0; round < rounds; ++round) {
            try {
                const Mesh mesh = test::parse(mutated(seed.bytes, random), seed.format);
                check_promises(mesh);
                check_mesh(mesh);
                ++read;
            } catch (const InputError& error) {
                CHECK(test::contains(error.what(), "model:"));
            }
        }
        CHECK(read > 0);
        CHECK(read < rounds);
    }
}

TEST_CASE(
    "read_mesh: every file in the folder ZSKEL_SHARED_MODELS is read or refused with its name") {
    const char* folder = std::getenv("ZSKEL_SHARED_MODELS");
    if (folder == nullptr || !fs::is_directory(folder)) {
        MESSAGE("skipped: set ZSKEL_SHARED_MODELS to a folder of models");
        return;
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const std::string path = entry.path().string();
        CAPTURE(path);
        try {
            const Mesh mesh = read_mesh(path);
            check_promises(mesh);
            CHECK(check_mesh(mesh).triangles == mesh.triangles.size());
        } catch (const InputError& error) {
            CHECK(test::contains(error.what(), path));
        }
    }
}

}  // namespace

TEST_CASE("parse_mesh: more triangles than allowed are refused before they are made") {
    const auto parse = [](const std::string& text, MeshFormat format, std::size_t max_faces) {
        return parse_mesh(std::as_bytes(std::span(text)), format, "model",
                          {.max_faces = max_faces});
    };
    const std::string two = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\n";
    CHECK(parse(two, MeshFormat::Obj, 3).triangles.size() == 3);
    CHECK_THROWS_WITH_AS(
        parse(two, MeshFormat::Obj, 2),
        "model: face 2 makes it 3 triangles, more than the 2 that --max-faces allows", LimitError);

    std::string round = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf";
    for (int corner = 0; corner < 100'000; ++corner) round += " 1 2 3";
    CHECK_THROWS_AS(parse(round, MeshFormat::Obj, 1000), LimitError);

    const std::string off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    CHECK_THROWS_AS(parse(off, MeshFormat::Off, 1), LimitError);
    const std::string stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 1 0\nvertex 1 0 0\n"
        "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    CHECK(parse(stl, MeshFormat::Stl, 2).triangles.size() == 2);
    CHECK_THROWS_AS(parse(stl, MeshFormat::Stl, 1), LimitError);
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    CHECK_THROWS_AS(parse(ply, MeshFormat::Ply, 1), LimitError);
}

}  // namespace zskel
