#pragma once

#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Directions in which an eye samples what it sees, and the share of the sphere that each stands
/// for.
struct Directions {
    std::vector<DVec3> unit;     ///< unit vectors
    std::vector<double> weight;  ///< solid angle over 4 pi; sums to 1
    int face_px = 0;             ///< texels along a cube face; 0 when these are no cube map

    std::size_t size() const { return unit.size(); }
};

/// `count` directions spread evenly over the sphere (a golden-angle spiral), all of one weight: our
/// form of the paper's radial parameterisation (section 4.1, with 197 directions in its Table 1).
/// @throws UsageError unless 4 <= count <= 10^6.
Directions radial_directions(int count);

}  // namespace zskel
