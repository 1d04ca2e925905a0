#pragma once

#include <cmath>

#include "zskel/core/types.h"

namespace zskel {

/// Two unit directions at right angles to a third (unit) and to each other.
struct Across {
    DVec3 right;
    DVec3 up;

    explicit Across(const DVec3& ahead)
        : right(glm::normalize(
              glm::cross(ahead, std::abs(ahead.x) < 0.8 ? DVec3(1, 0, 0) : DVec3(0, 1, 0)))),
          up(glm::cross(ahead, right)) {}

    DVec3 at(double angle) const { return right * std::cos(angle) + up * std::sin(angle); }
};

}  // namespace zskel
