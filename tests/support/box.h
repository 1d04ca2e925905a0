#pragma once

#include "zskel/mesh/mesh.h"

namespace zskel::test {

/// Adds an axis-aligned box of twelve triangles, facing outward.
inline void add_box(Mesh& mesh, const DVec3& low, const DVec3& high) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                    (i & 4) != 0 ? high.z : low.z);
    }
    const glm::uvec4 quads[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const glm::uvec4& q : quads) {
        mesh.triangles.push_back(Triangle(q.x, q.y, q.z) + first);
        mesh.triangles.push_back(Triangle(q.x, q.z, q.w) + first);
    }
    mesh.face_count = mesh.triangles.size();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t >= mesh.face_of_triangle.size()) mesh.face_of_triangle.push_back(t);
    }
}

inline Mesh make_box(const DVec3& low, const DVec3& high) {
    Mesh mesh;
    mesh.name = "box";
    add_box(mesh, low, high);
    return mesh;
}

}  // namespace zskel::test
