#pragma once

#include <cstdint>
#include <span>
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

/// The free way straight in from every vertex, along the reverse of its normal: the local
/// thickness. Nowhere more than a few times the model's size, also where nothing is met. Of
/// more than 50,000 vertices those much nearer to a neighbour than the thickness there have the
/// neighbour's: a third of them are looked from.
std::vector<float> vertex_thickness(const Surface& surface, const SurfaceQuery& query);

/// The point just inside every vertex. A vertex without a normal keeps its own position.
/// @see Wu et al. 2003, section 4.1; the bound by the local thickness is ours.
std::vector<Vec3> inner_points(const Surface& surface, std::span<const float> thickness,
                               const SeedOptions& options);

/// The points, moved where the way between those of two neighbours is not free: first to the inner
/// side of all faces at their vertices, then towards the vertices. Walks along the surface's edges
/// stay inside; but a vertex that has no such side keeps its point.
std::vector<Vec3> walkable_points(const Surface& surface, const SurfaceQuery& query,
                                  std::vector<Vec3> inner);

/// One seed inside each vertex.
std::vector<Seed> place_seeds(const Surface& surface, const SurfaceQuery& query,
                              const SeedOptions& options);

}  // namespace zskel
