#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "zskel/mesh/mesh.h"
#include "zskel/mesh/surface.h"

namespace zskel::test {

inline void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.face_of_triangle.push_back(static_cast<std::uint32_t>(mesh.face_count++));
}

/// The cube [-1/2, 1/2]^3: 8 corners, 12 triangles, outward.
inline Mesh cube() {
    Mesh mesh;
    mesh.name = "cube";
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5);
    }
    const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads) {
        add_triangle(mesh, q[0], q[1], q[2]);
        add_triangle(mesh, q[0], q[2], q[3]);
    }
    return mesh;
}

/// Every triangle into four; `place` puts the new vertices where they belong.
template <typename Place>
Mesh subdivided(const Mesh& coarse, Place place) {
    Mesh fine;
    fine.name = coarse.name;
    fine.positions = coarse.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(fine.positions.size()));
        if (is_new)
            fine.positions.push_back(place((coarse.positions[a] + coarse.positions[b]) * 0.5));
        return at->second;
    };
    for (const Triangle& t : coarse.triangles) {
        const std::uint32_t ab = middle(t.x, t.y);
        const std::uint32_t bc = middle(t.y, t.z);
        const std::uint32_t ca = middle(t.z, t.x);
        add_triangle(fine, t.x, ab, ca);
        add_triangle(fine, ab, t.y, bc);
        add_triangle(fine, ca, bc, t.z);
        add_triangle(fine, ab, bc, ca);
    }
    return fine;
}

/// The same shape, every triangle in sixteen.
inline Mesh finer(const Mesh& mesh) {
    const auto stay = [](const DVec3& p) { return p; };
    return subdivided(subdivided(mesh, stay), stay);
}

/// A sphere about the origin: a cube's faces, subdivided and pushed out. 12 * 4^levels triangles.
inline Mesh sphere(double radius = 0.5, int levels = 4) {
    const auto push_out = [&](const DVec3& p) { return glm::normalize(p) * radius; };
    Mesh mesh = cube();
    mesh.name = "sphere";
    for (DVec3& p : mesh.positions) p = push_out(p);
    for (int i = 0; i < levels; ++i) mesh = subdivided(mesh, push_out);
    return mesh;
}

/// A surface of `rings` closed rings of `sides` points, joined one to the next, with a cap at each
/// end. `ring(i)` maps to the ring's centre, and `point(i, angle)` to its points.
template <typename Center, typename Point>
Mesh capped_rings(int rings, int sides, Center center, Point point) {
    Mesh mesh;
    const auto n = static_cast<std::uint32_t>(sides);
    for (int i = 0; i < rings; ++i) {
        for (int k = 0; k < sides; ++k)
            mesh.positions.push_back(point(i, 2 * std::numbers::pi * k / sides));
    }
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(center(0));
    mesh.positions.push_back(center(rings - 1));
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t next = (k + 1) % n;
        for (std::uint32_t i = 0; i + 1 < static_cast<std::uint32_t>(rings); ++i) {
            add_triangle(mesh, i * n + k, i * n + next, (i + 1) * n + next);
            add_triangle(mesh, i * n + k, (i + 1) * n + next, (i + 1) * n + k);
        }
        const std::uint32_t last = (static_cast<std::uint32_t>(rings) - 1) * n;
        add_triangle(mesh, first, next, k);
        add_triangle(mesh, first + 1, last + k, last + next);
    }
    return mesh;
}

/// A closed cylinder about the z axis, centred at the origin.
inline Mesh cylinder(double radius, double length, int sides = 96, int rings = 65) {
    const auto height = [=](int i) { return length * (i / (rings - 1.0) - 0.5); };
    Mesh mesh = capped_rings(
        rings, sides, [&](int i) { return DVec3(0, 0, height(i)); },
        [&](int i, double angle) {
            return DVec3(radius * std::cos(angle), radius * std::sin(angle), height(i));
        });
    mesh.name = "cylinder";
    return mesh;
}

/// A torus about the z axis.
inline Mesh torus(double ring_radius = 0.35, double tube_radius = 0.12, int around = 64,
                  int across = 24) {
    Mesh mesh;
    mesh.name = "torus";
    const auto m = static_cast<std::uint32_t>(across);
    for (int i = 0; i < around; ++i) {
        for (int k = 0; k < across; ++k) {
            const double a = 2 * std::numbers::pi * i / around;
            const double b = 2 * std::numbers::pi * k / across;
            const double r = ring_radius + tube_radius * std::cos(b);
            mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a),
                                        tube_radius * std::sin(b));
        }
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(around); ++i) {
        const std::uint32_t j = (i + 1) % static_cast<std::uint32_t>(around);
        for (std::uint32_t k = 0; k < m; ++k) {
            const std::uint32_t l = (k + 1) % m;
            add_triangle(mesh, i * m + k, j * m + k, j * m + l);
            add_triangle(mesh, i * m + k, j * m + l, i * m + l);
        }
    }
    return mesh;
}

/// Moved and scaled: p * scale + offset.
inline Mesh moved(Mesh mesh, const DVec3& offset, double scale = 1.0) {
    for (DVec3& p : mesh.positions) p = p * scale + offset;
    return mesh;
}

/// Both in one mesh, `b`'s vertices after `a`'s.
// Turned by an odd angle about an odd axis, so that no direction of a cube map runs along an edge.
inline Mesh askew(Mesh mesh) {
    const glm::dquat turn = glm::angleAxis(0.6543, glm::normalize(DVec3(0.3, -0.8, 0.51)));
    for (DVec3& p : mesh.positions) p = turn * p;
    return mesh;
}

inline Mesh together(Mesh a, const Mesh& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const Triangle& t : b.triangles) add_triangle(a, t.x + first, t.y + first, t.z + first);
    return a;
}

inline Mesh turned_inside_out(Mesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

}  // namespace zskel::test
