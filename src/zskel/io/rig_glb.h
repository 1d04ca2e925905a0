#pragma once

#include <string>

#include "zskel/rig/pose.h"
#include "zskel/rig/weights.h"

namespace zskel {

/// Where all bones are at a time.
struct RigKey {
    double seconds = 0.0;
    std::vector<BoneMotion> motions;
};

/// A mesh bound to bones, as a binary glTF 2.0 file: full resolution, the model's own scale and
/// axes, vertices in their order. One joint a bone, at its head and unturned, and one more at the
/// tail of bones on which none hangs ("branch3.1_end"), so that viewers show how long those are.
/// Positions are 32-bit, as the format asks; a model far from the origin, where those would be too
/// coarse, is written about its own middle, and the node that holds the joints stands there. With
/// keys the file holds an animation: joints go from one key to the next; what stretches hangs on a
/// joint of its own ("branch3.1_stretch"), so that it does not stretch what follows. Viewers place
/// vertices by the mean of their joints (`Linear`).
/// @param weights  as `skin_weights` gives them; of each vertex the first four count.
/// @param keys     in order of time; none: no animation.
/// @param origin   says what made the file.
/// @throws InputError when there are more joints than the format can number (65,535).
std::string write_rig_glb(const Mesh& mesh, const Armature& armature,
                          const std::vector<std::vector<Influence>>& weights,
                          const std::vector<RigKey>& keys, const std::string& origin);

}  // namespace zskel
