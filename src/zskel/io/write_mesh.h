#pragma once

#include <string>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Wavefront OBJ: positions with every digit that they have, and triangles between them.
/// @param origin  says what made the file.
std::string write_obj_mesh(const std::vector<DVec3>& positions,
                           const std::vector<Triangle>& triangles, const std::string& origin);

}  // namespace zskel
