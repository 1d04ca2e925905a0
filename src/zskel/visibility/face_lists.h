#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// For one eye: the triangles that can show on each face of its cube map, in rising order.
struct FaceLists {
    std::array<std::vector<std::uint32_t>, 6> triangles;
    std::vector<std::uint16_t> vertex_codes;  // scratch
};

/// Leaves out of each face's list the triangles that lie wholly beyond one of the five planes of
/// its pyramid; what is left may still miss the face. A software driver clips every triangle that
/// it is given, so this takes most of its work away. O(vertices + triangles).
void list_faces(const Surface& surface, const Vec3& eye, FaceLists& lists);

}  // namespace zskel
