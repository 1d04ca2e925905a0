#pragma once

#include <array>

#include "zskel/core/types.h"

namespace zskel {

/// Eigenvalues of a symmetric 3x3 matrix, largest first, with orthonormal vectors.
struct Eigen3 {
    std::array<double, 3> values{};
    std::array<DVec3, 3> vectors{};
};

/// @param m  xx yy zz xy xz yz.
Eigen3 eigen_symmetric(const std::array<float, 6>& m);

}  // namespace zskel
