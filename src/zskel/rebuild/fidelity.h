#pragma once

#include <vector>

#include "zskel/mesh/mesh.h"
#include "zskel/rebuild/recall.h"

namespace zskel {

/// Of every place (on the surface, model space) whether some map's plane passes it nearer than
/// `within`, model units.
std::vector<char> are_seen(const std::vector<DVec3>& places, const VisibilityMaps& maps,
                           double within);

/// How much of a surface its nodes' maps hold.
/// @param within  a place counts as seen when a map's plane passes it this near, model units.
/// @return share of the surface's area.
double share_seen(const Mesh& mesh, const VisibilityMaps& maps, double within);

/// From every place to the nearest of a surface, model units.
std::vector<double> distances_to(const Mesh& to, const std::vector<DVec3>& places);

/// Distances between two surfaces, at 50,000 places spread evenly by area over each, model units.
struct SurfaceDistances {
    double mean = 0.0;       ///< from both, the larger of the two means
    double hausdorff = 0.0;  ///< the largest found, either way
};
SurfaceDistances distances_between(const Mesh& a, const Mesh& b);

}  // namespace zskel
