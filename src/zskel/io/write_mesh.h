#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Wavefront OBJ: positions with every digit that they have, and triangles between them.
/// @param origin  says what made the file.
std::string write_obj_mesh(const std::vector<DVec3>& positions,
                           const std::vector<Triangle>& triangles, const std::string& origin);

/// Binary little-endian PLY: 32-bit positions and triangles between them.
std::string write_ply_mesh(const std::vector<DVec3>& positions,
                           const std::vector<Triangle>& triangles, const std::string& origin);

/// Binary little-endian PLY: points with unit normals, 32-bit.
std::string write_ply_points(const std::vector<DVec3>& positions, const std::vector<DVec3>& normals,
                             const std::string& origin);

/// OBJ or PLY, as the extension of `path` says; "-" is OBJ.
/// @throws UsageError for another extension.
std::string write_mesh_as(std::string_view path, const std::vector<DVec3>& positions,
                          const std::vector<Triangle>& triangles, const std::string& origin);

}  // namespace zskel
