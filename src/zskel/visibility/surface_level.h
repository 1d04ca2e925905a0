#pragma once

#include <optional>

#include "zskel/mesh/surface.h"

namespace zskel {

/// A coarser surface in the place of one.
struct SurfaceLevel {
    Surface surface;           ///< positions, triangles and their normals
    float error_world = 0.0f;  ///< about how far the two are apart where that is most
};

/// Vertices that share a cell of a grid become one of them, the best by their planes' quadrics;
/// what is thinner than a cell falls together. About 0.1 microseconds a triangle. (Collapsing edges
/// one by one to the same number keeps seven times nearer and takes ten times as long.)
/// @param share  of the triangles, about, that are to be left.
/// @return       nothing when none are.
/// @see meshoptimizer's meshopt_simplifySloppy.
std::optional<SurfaceLevel> coarser_level(const Surface& surface, double share);

}  // namespace zskel
