#include "zskel/io/write_mesh.h"

#include <fmt/format.h>

#include <iterator>

#include "zskel/core/error.h"
#include "zskel/io/little_endian.h"

namespace zskel {
namespace {

std::string ply_begin(const std::string& origin, std::size_t vertices) {
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\nproperty double x\n"
        "property double y\nproperty double z\n",
        origin, vertices);
}

// In full: far from the origin a float's steps are wider than the model's edges.
void append_point(std::string& out, const DVec3& p) {
    for (int k = 0; k < 3; ++k) append_little_endian(out, p[k]);
}

}  // namespace

std::string write_obj_mesh(const std::vector<DVec3>& positions,
                           const std::vector<Triangle>& triangles, const std::string& origin) {
    std::string out = fmt::format("# {}\n", origin);
    for (const DVec3& p : positions)
        fmt::format_to(std::back_inserter(out), "v {} {} {}\n", p.x, p.y, p.z);
    for (const Triangle& t : triangles)
        fmt::format_to(std::back_inserter(out), "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return out;
}

std::string write_ply_mesh(const std::vector<DVec3>& positions,
                           const std::vector<Triangle>& triangles, const std::string& origin) {
    std::string out = ply_begin(origin, positions.size()) +
                      fmt::format(
                          "element face {}\nproperty list uchar uint vertex_indices\n"
                          "end_header\n",
                          triangles.size());
    out.reserve(out.size() + 24 * positions.size() + 13 * triangles.size());
    for (const DVec3& p : positions) append_point(out, p);
    for (const Triangle& t : triangles) {
        out.push_back(3);
        for (int k = 0; k < 3; ++k) append_little_endian(out, t[k]);
    }
    return out;
}

std::string write_ply_points(const std::vector<DVec3>& positions, const std::vector<DVec3>& normals,
                             const std::string& origin) {
    std::string out = ply_begin(origin, positions.size()) +
                      "property float nx\nproperty float ny\nproperty float nz\nend_header\n";
    for (std::size_t i = 0; i < positions.size(); ++i) {
        append_point(out, positions[i]);
        for (int k = 0; k < 3; ++k) append_little_endian(out, static_cast<float>(normals[i][k]));
    }
    return out;
}

std::string write_mesh_as(std::string_view path, const std::vector<DVec3>& positions,
                          const std::vector<Triangle>& triangles, const std::string& origin) {
    if (path == "-" || path.ends_with(".obj")) return write_obj_mesh(positions, triangles, origin);
    if (path.ends_with(".ply")) return write_ply_mesh(positions, triangles, origin);
    throw UsageError(fmt::format("{}: meshes are written as .obj or .ply", path));
}

}  // namespace zskel
