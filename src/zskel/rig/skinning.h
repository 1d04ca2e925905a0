#pragma once

#include <optional>
#include <vector>

#include "zskel/rig/pose.h"
#include "zskel/rig/weights.h"

namespace zskel {

/// How a vertex between bones follows them.
enum class Skinning {
    DualQuaternion,  ///< keeps the girth where a limb bends or twists
    Linear,          ///< the mean of the places; what most engines do
};

/// The vertices of a mesh in a pose.
/// @see Kavan et al. 2007 (dual quaternion skinning)
std::vector<DVec3> deform(const Mesh& mesh, const Armature& armature,
                          const std::vector<std::vector<Influence>>& weights,
                          const std::vector<BoneMotion>& motions, Skinning skinning);

/// The skeleton in that pose. Nodes at joints go with the first of the bones that meet there, so
/// that edges get longer or shorter where a bone turns beside its head.
SkeletonGraph deform_skeleton(const SkeletonGraph& graph, const Armature& armature,
                              const std::vector<BoneMotion>& motions);

/// What a deformation did to a mesh.
struct DeformMeasures {
    std::optional<double> volume_change;  ///< share of the volume, signed; none on open surfaces
    std::size_t flipped_faces = 0;        ///< that look away from where their bones turned them
    std::size_t crossing_faces = 0;       ///< that pass through another face
    std::size_t crossing_at_rest = 0;     ///< that did so before
    double edge_stretch_median = 1.0;     ///< length over the length at rest
    double edge_stretch_p99 = 1.0;  ///< the larger of that and its inverse, at 99 % of the edges
    double edge_stretch_worst = 1.0;
    double farthest = 0.0;  ///< that a vertex moved, in diagonals of the bounding box
};
DeformMeasures measure_deformation(const Mesh& mesh, const std::vector<DVec3>& deformed,
                                   const std::vector<std::vector<Influence>>& weights,
                                   const std::vector<BoneMotion>& motions);

}  // namespace zskel
