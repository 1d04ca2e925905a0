#include "zskel/skeleton/volumes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace zskel {
namespace {

double tetrahedron(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& d) {
    return glm::dot(glm::cross(b - a, c - a), a - d) / 6.0;
}

}  // namespace

std::vector<double> node_volumes(const Surface& surface, std::span<const std::uint32_t> vertex_node,
                                 std::span<const Vec3> nodes) {
    std::vector<double> out(nodes.size(), 0.0);
    double total = 0.0;
    for (const glm::uvec3& triangle : surface.triangles) {
        // The prism from the triangle to the nodes of its corners, cut into three from the lowest
        // vertex up, so that neighbours cut the side between them alike.
        std::array<std::uint32_t, 3> v{triangle.x, triangle.y, triangle.z};
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        const bool is_odd = v[1] > v[2];
        if (is_odd) std::swap(v[1], v[2]);
        std::array<DVec3, 3> p;
        std::array<DVec3, 3> q;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = DVec3(surface.positions[v[i]]);
            q[i] = DVec3(nodes[vertex_node[v[i]]]);
        }
        const double sign = is_odd ? -1.0 : 1.0;
        const double sweep =
            sign * (tetrahedron(p[0], p[1], p[2], q[2]) + tetrahedron(p[0], p[1], q[2], q[1]) +
                    tetrahedron(p[0], q[1], q[2], q[0]));
        for (const std::uint32_t corner : v) out[vertex_node[corner]] += sweep / 3.0;
        total += sign * tetrahedron(p[0], p[1], p[2], DVec3(0.0));
    }
    for (double& volume : out) volume = std::max(volume, 0.0);
    const double sum = std::accumulate(out.begin(), out.end(), 0.0);
    for (double& volume : out) volume *= sum > 0.0 ? total / sum : 0.0;
    return out;
}

}  // namespace zskel
