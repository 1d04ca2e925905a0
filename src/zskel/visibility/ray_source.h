#pragma once

#include <memory>

#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// How a ray finds its first triangle.
enum class RayMethod {
    Embree,      ///< a bounding volume hierarchy, 16 rays at a time
    BruteForce,  ///< every ray against every triangle, as the paper did; a reference, and slow
};

/// Visibility by rays along any directions (a cube map's texels, or `radial_directions`).
/// `solid` must outlive the source.
std::unique_ptr<VisibilitySource> make_ray_source(const Surface& solid, Directions directions,
                                                  RayMethod method = RayMethod::Embree);

}  // namespace zskel
