#pragma once

#include <string>

#include "zskel/mesh/mesh.h"

namespace zskel {

/// Wavefront OBJ: the positions in the mesh's order, every digit that they have, and its triangles.
/// @param positions  one a vertex of the mesh.
/// @param origin     says what made the file.
std::string write_obj_mesh(const Mesh& mesh, const std::vector<DVec3>& positions,
                           const std::string& origin);

}  // namespace zskel
