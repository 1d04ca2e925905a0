#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// A triangle mesh as it came from a file or a caller, in model space. Nothing is repaired here:
/// vertex numbers are the input's own, faces keep the input's order and winding.
struct Mesh {
    std::string name;                             ///< where it came from, for messages
    std::vector<DVec3> positions;                 ///< one per input vertex, finite
    std::vector<Triangle> triangles;              ///< indices below positions.size()
    std::vector<std::uint32_t> face_of_triangle;  ///< input face (polygon) of every triangle
    std::size_t face_count = 0;                   ///< faces (polygons) of the input
    std::vector<std::string> warnings;            ///< what reading had to change or leave out
    std::uint64_t hash = 0;  ///< XXH3-64 of the bytes that were read; 0 for a caller's arrays
};

}  // namespace zskel
