#pragma once

#include <vector>

#include "zskel/core/types.h"
#include "zskel/rebuild/recall.h"

namespace zskel {

struct RebuiltMesh {
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;  ///< counter-clockwise seen from outside
    double voxel = 0.0;               ///< side of the cubes that it was sampled in, model units
};

struct RebuildOptions {
    /// Side of the sampling cubes, model units; 0: half the radius of the thinnest parts, bounded
    /// by kFewestVoxels and kMostVoxels along the longest side of what was seen.
    double voxel_model = 0.0;
};
inline constexpr double kFewestVoxels = 200.0;
inline constexpr double kMostVoxels = 300.0;

/// The surface of what is recalled: watertight whatever the maps hold, since it bounds an inside.
/// Sampled in cubes from the surfels on, as far as the surface goes.
/// @throws InputError when no map saw anything, UsageError for a voxel that is too small for the
/// size of the whole.
RebuiltMesh rebuild_surface(const VisibilityMaps& maps, const RebuildOptions& options);

}  // namespace zskel
