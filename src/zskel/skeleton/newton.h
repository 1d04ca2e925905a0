#pragma once

#include <span>
#include <vector>

#include "zskel/skeleton/settle.h"

namespace zskel {

struct NewtonOptions {
    int max_steps = 10;       ///< 0: seeds rest where they start
    double third_axis = 0.5;  ///< moves along the weakest axis only when its eigenvalue is above
                              ///< this share of the second: along a limb the force says nothing
    double eigenvalue_floor = 0.05;  ///< of the largest; a weaker second axis is not moved along
                                     ///< either: that is a sheet
    double trust_nearest = 0.8;      ///< longest step, in distances to the nearest surface
    double reversal_damping = 0.6;   ///< each time a step turns back
    double stop_world = 0.0015;      ///< a shorter step is not taken: the seed is at rest
    double stop_nearest = 0.1;  ///< nor one shorter than this share of the distance to the surface
    double core_nearest = 0.3;  ///< as near to a place where a seed has come to rest, in distances
                                ///< from there to the surface, a seed ends there too; 0: never
};

/// Moves every seed to where the force vanishes across the limb it is in: one jump to the middle of
/// the chord ahead, then Newton steps on the force with the Jacobian of each record, in its two
/// strongest axes, between flat walls in the strongest. A step that raises the force across the
/// limb, or leaves the solid, is halved. What comes near a place where another has come to rest
/// joins it. Paths are always kept.
/// @throws GlError; whatever `progress` throws.
std::vector<SettledSeed> settle_seeds_newton(VisibilitySource& source, std::span<const Seed> seeds,
                                             const NewtonOptions& options,
                                             const SettleProgress& progress = {});

}  // namespace zskel
