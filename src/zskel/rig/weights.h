#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/mesh.h"
#include "zskel/rig/armature.h"

namespace zskel {

struct Influence {
    std::uint32_t bone = 0;
    float weight = 0.0f;
};

struct WeightOptions {
    double smoothing_radii = 0.6;    ///< how far a bone's hold fades out over the surface, in radii
    std::size_t max_influences = 4;  ///< a vertex keeps its strongest
    double least_weight = 0.01;      ///< weaker ones are left out, at each end of a joint alike
};

/// How much every vertex of a mesh follows each bone: positive, the strongest first, summing to 1.
///
/// Every vertex starts with the nearest of the bones at its node: which node that is was settled by
/// what the surface's points see, and its patch hangs together on the surface, so that a leg never
/// takes from the leg beside it. The steps between bones are then smoothed by diffusion along the
/// surface, (L + H) w = H h for every bone: L the cotangent Laplacian (no weight below 0, hence no
/// w below 0), H = area / max(smoothing * radius, sqrt(area))^2, h 1 where the vertex started with
/// the bone. The radius is that of the vertex's node, so thin limbs have sharp joints. Of what
/// diffuses to a vertex only bones count that its own hangs on, or that hang on its own; and what
/// lies between two limbs follows the one that pulls more, by as much as it pulls more, and for the
/// rest what both hang on: no vertex follows two limbs. Vertices without a face, or without a node,
/// follow the nearest bone.
/// @param graph  of that mesh: its `vertex_node` is what counts.
/// @see Baran and Popovic 2007 (heat weights); there heat starts where a straight way to the
/// nearest bone is free, here from the patches.
/// @throws InputError when the mesh is not the graph's.
std::vector<std::vector<Influence>> skin_weights(const Mesh& mesh, const SkeletonGraph& graph,
                                                 const Armature& armature,
                                                 const WeightOptions& options);

}  // namespace zskel
