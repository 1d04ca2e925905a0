#pragma once

#include <span>

#include "zskel/core/types.h"

namespace zskel {

/// What triangles bound, model units cubed: negative when their fronts are inside. Of the cones
/// from the first position, so that far from the origin no digits are lost.
/// @param positions  not empty.
inline double signed_volume(std::span<const DVec3> positions, std::span<const Triangle> triangles) {
    const DVec3& from = positions.front();
    double volume = 0.0;
    for (const Triangle& t : triangles) {
        volume += glm::dot(positions[t.x] - from,
                           glm::cross(positions[t.y] - from, positions[t.z] - from)) /
                  6.0;
    }
    return volume;
}

}  // namespace zskel
