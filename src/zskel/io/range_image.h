#pragma once

#include <span>

#include "zskel/core/types.h"
#include "zskel/io/png.h"

namespace zskel {

/// What marks the force and what stands for a miss, sRGB.
inline constexpr Vec3 kForceColor{0.84f, 0.37f, 0.00f};
inline constexpr Vec3 kMissColor{0.80f, 0.47f, 0.65f};

/// A cube map as a range image, unfolded into a cross: -X -Z +X +Z from left to right seen from
/// inside with y up, +Y above and -Y below -Z. Brightness falls with the logarithm of the distance,
/// from the nearest texel to the farthest. A disc marks where the force points to, a ring the
/// opposite direction.
/// @param distance  6 face_px^2 radial distances, +inf for a miss.
/// @param force     any length; nothing is marked when it is zero.
/// @param width_px  a multiple of 4 times face_px keeps every texel the same size; height is 3/4 of
/// it.
/// @see Wu et al. 2003, Figure 2.
Image range_image(int face_px, std::span<const float> distance, const DVec3& force,
                  int width_px = 1600);

}  // namespace zskel
