#pragma once

#include <map>
#include <tuple>

#include "support/shapes.h"

namespace zskel::test {

/// Numbers of unit cubes along x, y and z.
struct Grid {
    int x;
    int y;
    int z;
};

/// The boundary of a set of unit cubes, outward; every side of a cube is split `pieces` by `pieces`
/// times into two triangles. Manifold when no two cubes of the set touch in a corner or an edge
/// alone. @param is_filled  (x, y, z) -> bool, asked inside the grid only.
template <typename IsFilled>
Mesh voxels(const Grid& grid, int pieces, IsFilled is_filled) {
    Mesh mesh;
    mesh.name = "voxels";
    std::map<std::tuple<int, int, int>, std::uint32_t> known;
    const auto filled = [&](const int(&c)[3]) {
        return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < grid.x && c[1] < grid.y &&
               c[2] < grid.z && is_filled(c[0], c[1], c[2]);
    };
    const auto add_side = [&](const int(&cube)[3], int axis, int end) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const auto vertex = [&](int i, int j) {
            int p[3];
            p[axis] = (cube[axis] + end) * pieces;
            p[u] = cube[u] * pieces + (end == 1 ? i : j);
            p[v] = cube[v] * pieces + (end == 1 ? j : i);
            const auto [at, is_new] = known.try_emplace(
                {p[0], p[1], p[2]}, static_cast<std::uint32_t>(mesh.positions.size()));
            if (is_new) mesh.positions.push_back(DVec3(p[0], p[1], p[2]) / double(pieces));
            return at->second;
        };
        for (int i = 0; i < pieces; ++i) {
            for (int j = 0; j < pieces; ++j) {
                add_triangle(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
                add_triangle(mesh, vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
            }
        }
    };
    for (int k = 0; k < grid.x * grid.y * grid.z; ++k) {
        const int cube[3] = {k % grid.x, k / grid.x % grid.y, k / grid.x / grid.y};
        if (!filled(cube)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            for (int end = 0; end < 2; ++end) {
                int next[3] = {cube[0], cube[1], cube[2]};
                next[axis] += end == 1 ? 1 : -1;
                if (!filled(next)) add_side(cube, axis, end);
            }
        }
    }
    return mesh;
}

/// A plate with columns x rows square holes: as many handles.
inline Mesh plate_with_holes(int columns, int rows, int pieces) {
    return voxels({2 * columns + 1, 2 * rows + 1, 1}, pieces,
                  [](int x, int y, int) { return x % 2 == 0 || y % 2 == 0; });
}

/// The edges of n x n x n cubes, as bars: 3 n (n + 1)^2 bars between (n + 1)^3 corners.
inline Mesh jungle_gym(int n, int pieces) {
    return voxels({2 * n + 1, 2 * n + 1, 2 * n + 1}, pieces,
                  [](int x, int y, int z) { return x % 2 + y % 2 + z % 2 <= 1; });
}

/// A slab with n x n tunnels through it, and as many handles on top, like those of a suitcase.
inline Mesh slab_with_handles(int n, int pieces) {
    return voxels({4 * n, 4 * n, 4}, pieces, [](int x, int y, int z) {
        if (z < 2) return x % 4 != 1 || y % 4 != 1;
        return y % 4 == 3 && (z == 3 ? x % 4 <= 2 : x % 4 == 0 || x % 4 == 2);
    });
}

}  // namespace zskel::test
