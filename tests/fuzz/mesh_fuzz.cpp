// Any bytes as a model of one format, which ZSKEL_FUZZ_FORMAT names.
#include <cmath>
#include <span>

#include "fuzz.h"
#include "zskel/mesh/read_mesh.h"

using namespace zskel;

namespace {

// Surfaces by formula are divided coarsely, so that an execution takes milliseconds.
constexpr ReadOptions kOptions{.chord_error = 0.05, .max_faces = 100000};

void check(const Mesh& mesh) {
    fuzz::require(!mesh.triangles.empty(), "a mesh that was read has triangles");
    fuzz::require(mesh.face_of_triangle.size() == mesh.triangles.size(),
                  "every triangle has its face");
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k)
            fuzz::require(t[k] < mesh.positions.size(), "corners are vertices");
    }
    for (const std::uint32_t face : mesh.face_of_triangle)
        fuzz::require(face < mesh.face_count, "faces are numbered from 0 up");
    for (const DVec3& p : mesh.positions) {
        fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                      "positions are finite");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::answer([&] {
        check(parse_mesh(std::as_bytes(std::span(data, size)), MeshFormat::ZSKEL_FUZZ_FORMAT,
                         "model", kOptions));
    });
    return 0;
}
