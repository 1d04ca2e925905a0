#pragma once

#include <vector>

#include "zskel/mesh/mesh.h"
#include "zskel/rig/weights.h"

namespace zskel {

/// Moves the joint of every bone that hangs on another (`Bone::to_joint`) to the nearest place
/// about which small bends of what hangs there keep the volume: where a limb is cut straight
/// across, onto a line through the centroid of the cut. A skeleton is centred between the walls of
/// a section and misses that centroid where the section has no centre of symmetry; a bend by 45
/// degrees about a place e off the centroid of a section of area A changes the volume by up to 0.79
/// e A. Joints that would go farther than three quarters of the bone's radius stay at the bone's
/// head, as those do on which all of a part hangs. Openings count as capped.
/// @param mesh  as it was skinned; what counts is its surface as `prepare_surface` mends it.
void centre_joints(const Mesh& mesh, const std::vector<std::vector<Influence>>& weights,
                   Armature& armature);

}  // namespace zskel
