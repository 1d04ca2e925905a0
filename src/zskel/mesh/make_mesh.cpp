#include "zskel/mesh/make_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "zskel/core/error.h"

namespace zskel {
namespace {

template <typename Number>
void copy_positions(const Number* xyz, std::size_t vertices, Mesh& mesh) {
    mesh.positions.reserve(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const DVec3 p(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]);
        for (int k = 0; k < 3; ++k) {
            if (!std::isfinite(p[k])) {
                throw InputError(fmt::format("{}: vertex {} has {} = {}; expected a finite number",
                                             mesh.name, v, "xyz"[k], p[k]));
            }
        }
        mesh.positions.push_back(p);
    }
}

void copy_triangles(const std::uint32_t* corners, std::size_t triangles, Mesh& mesh) {
    mesh.triangles.reserve(triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
        const Triangle triangle(corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]);
        for (int k = 0; k < 3; ++k) {
            if (triangle[k] >= mesh.positions.size()) {
                throw InputError(
                    fmt::format("{}: corner {} of triangle {} is vertex {}; there are {}, "
                                "numbered from 0",
                                mesh.name, k, t, triangle[k], mesh.positions.size()));
            }
        }
        mesh.triangles.push_back(triangle);
    }
    mesh.face_of_triangle.resize(triangles);
    std::iota(mesh.face_of_triangle.begin(), mesh.face_of_triangle.end(), 0u);
    mesh.face_count = triangles;
}

template <typename Number>
Mesh make(const Number* xyz, std::size_t vertices, const std::uint32_t* corners,
          std::size_t triangles, std::string_view name) {
    if (triangles == 0) {
        throw InputError(fmt::format(
            "{}: the mesh has no triangles ({} vertices); expected at least one", name, vertices));
    }
    if (triangles >= kNone || vertices >= kNone) {
        throw InputError(
            fmt::format("{}: {} triangles on {} vertices; at most {} of each can be numbered", name,
                        triangles, vertices, kNone - 1));
    }
    Mesh mesh;
    mesh.name = name;
    copy_positions(xyz, vertices, mesh);
    copy_triangles(corners, triangles, mesh);
    return mesh;
}

}  // namespace

Mesh make_mesh(const double* xyz, std::size_t vertices, const std::uint32_t* corners,
               std::size_t triangles, std::string_view name) {
    return make(xyz, vertices, corners, triangles, name);
}

Mesh make_mesh(const float* xyz, std::size_t vertices, const std::uint32_t* corners,
               std::size_t triangles, std::string_view name) {
    return make(xyz, vertices, corners, triangles, name);
}

}  // namespace zskel
