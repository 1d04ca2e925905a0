#pragma once

#include <vector>

#include "zskel/mesh/mesh.h"
#include "zskel/rig/weights.h"

namespace zskel {

/// Moves the head of every bone that hangs on another to the nearest place about which no small
/// turn of what hangs there changes the volume: where a limb is cut straight across, onto a line
/// through the centroid of the cut. A skeleton is centred between the walls of a section and misses
/// that centroid where the section has no centre of symmetry; a bend by 45 degrees about a place
/// e off the centroid of a section of area A changes the volume by up to 0.79 e A. Heads that would
/// go farther than three quarters of the bone's radius stay.
/// Tails go with the one head that starts there. The weights stay as they are.
void centre_joints(const Mesh& mesh, const std::vector<std::vector<Influence>>& weights,
                   Armature& armature);

}  // namespace zskel
