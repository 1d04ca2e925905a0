#include "zskel/mesh/mesh_builder.h"

#include <fmt/format.h>

#include "zskel/core/error.h"
#include "zskel/mesh/triangulate.h"

namespace zskel {
namespace {

// For cutting polygons; what takes more is made to take long.
constexpr std::size_t kLooks = 100'000'000;
constexpr std::size_t kLooksPerCorner = 100;

}  // namespace

void MeshBuilder::reserve_faces(std::size_t faces) {
    sizes_.reserve(faces);
    corners_.reserve(faces * 3);
}

void MeshBuilder::warn(std::size_t count, std::string_view what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
}

void MeshBuilder::fail_too_many() const {
    throw LimitError(
        fmt::format("{}: face {} makes it {} triangles, more than the {} that "
                    "--max-faces allows",
                    name_, sizes_.size() + 1, triangles_, max_faces_));
}

Mesh MeshBuilder::finish() {
    if (sizes_.empty()) {
        throw InputError(
            fmt::format("{}: the model has no faces ({} vertices); expected at least one", name_,
                        positions.size()));
    }
    if (triangles_ >= kNone || positions.size() >= kNone) {
        throw InputError(
            fmt::format("{}: {} triangles on {} vertices; at most {} of each can be numbered",
                        name_, triangles_, positions.size(), kNone - 1));
    }
    Mesh mesh;
    mesh.triangles.reserve(triangles_);
    mesh.face_of_triangle.reserve(triangles_);
    std::size_t begin = 0;
    std::size_t fans = 0;
    std::size_t looks_left = kLooks + kLooksPerCorner * corners_.size();
    for (std::size_t face = 0; face < sizes_.size(); ++face) {
        const std::span corners(corners_.data() + begin, sizes_[face]);
        fans += triangulate(positions, corners, mesh.triangles, looks_left) ? 0 : 1;
        mesh.face_of_triangle.resize(mesh.triangles.size(), static_cast<std::uint32_t>(face));
        begin += sizes_[face];
    }
    warn(fans, "faces cross themselves, have no area, or take too long to cut; made fans");
    mesh.name = name_;
    mesh.face_count = sizes_.size();
    mesh.positions = std::move(positions);
    mesh.warnings = std::move(warnings);
    return mesh;
}

}  // namespace zskel
