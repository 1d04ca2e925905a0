#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "zskel/mesh/surface.h"
#include "zskel/visibility/directions.h"

namespace zskel {

/// What one eye sees: one entry a direction.
struct MapView {
    std::span<const float> distance;  ///< distance_radial, world units; +inf where nothing was hit
    std::span<const std::uint32_t>
        id;  ///< triangle that was hit; kNone where none was: the paper's V(x)
};

/// The net visible repulsive force at an eye.
struct Force {
    DVec3 vector{0.0};                   ///< world space, 1/length
    double mean_inverse_distance = 0.0;  ///< 1/length: the scale to judge |vector| by
    double hit_fraction = 0.0;           ///< share of the sphere that hits something
};

/// The mean over the sphere of -direction / distance; misses add nothing.
/// @param map  radial distances along `directions`; ids are not looked at.
/// @return     a zero vector with hit_fraction 0 when everything misses; nothing is thrown.
/// @see Wu et al. 2003, formula 1, with f(r) = r^-2. Differs: the sign (as printed it attracts),
/// the
///      exact solid-angle weight of each sample, and the mean in place of the sum. Sums run in a
///      fixed order.
Force force_at(const Directions& directions, const MapView& map);

/// All that stepping needs to know of an eye, small enough for a GPU to send thousands a step.
struct EyeRecord {
    Vec3 force{0.0f};                 ///< Force::vector
    std::array<float, 6> jacobian{};  ///< of -force: xx yy zz xy xz yz, symmetrised, 1/length^2
    float nearest = kInfinity;        ///< least distance_radial
    float clearance = kInfinity;  ///< least distance ahead: r cos(a) over samples with cos(a) >=
                                  ///< 0.8 to the force
    float back_fraction = 0.0f;   ///< share of the hits that see a triangle from behind; about 1
                                  ///< inside a solid, below 1/2 outside
    float hit_fraction = 0.0f;    ///< Force::hit_fraction
};
static_assert(sizeof(EyeRecord) == 52);

/// "Ahead" is within this cosine of the force.
inline constexpr float kAheadCosine = 0.8f;
/// Grazing samples count in the Jacobian as if they met the surface at this cosine.
inline constexpr float kGrazingCosine = 0.2f;

/// Reduces a map to its record. The Jacobian holds the visible set fixed: with a plane n.p = h seen
/// along D, 1/r = g.D for g = n/h, and the eye's move dx changes g by g (g.dx). n.D is floored at
/// 0.2 for grazing samples.
EyeRecord summarize(const Directions& directions, const MapView& map, const Surface& surface);

}  // namespace zskel
