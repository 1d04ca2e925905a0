#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/surface.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// A point that starts just inside the surface.
struct Seed {
    Vec3 position{0.0f};       ///< world space
    std::uint32_t vertex = 0;  ///< the surface vertex it stands for
};

struct SeedOptions {
    double offset_world = 0.005;        ///< how far in along the reverse normal
    double max_offset_thickness = 0.4;  ///< but no more than this share of the thickness there
};

/// One seed inside each vertex, pushed in along the reverse of the vertex normal. A vertex without
/// a normal keeps its own position.
/// @see Wu et al. 2003, section 4.1; the bound by the local thickness is ours.
std::vector<Seed> place_seeds(const Surface& surface, const SurfaceQuery& query,
                              const SeedOptions& options);

}  // namespace zskel
