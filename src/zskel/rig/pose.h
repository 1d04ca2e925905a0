#pragma once

#include <glm/gtc/quaternion.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/rig/armature.h"

namespace zskel {

/// What is done to one branch, or to one bone. All of it turns what hangs on it too.
struct Move {
    std::vector<std::uint32_t> bones;  ///< from the root outwards
    DVec3 axis{0.0};                   ///< that it turns and bends about, model space; unit
    double turn = 0.0;                 ///< radians, at the first bone's joint
    double bend = 0.0;                 ///< radians, shared out evenly over its bones
    double twist = 0.0;                ///< radians about its own bones, shared out evenly
    double stretch = 1.0;              ///< factor of its length
    double begin = 0.0;                ///< seconds; when it starts from rest
    double end = 1.0;                  ///< seconds; from when on all of it is done
};
using Pose = std::vector<Move>;

/// When all of a pose is done, in seconds; 0 without any move.
double duration(const Pose& pose);

/// On the way there: each move as far as it is done at that time, starting and ending gently.
Pose pose_at(const Pose& pose, double seconds);

/// Reads a pose:
///   {"moves": [{"branch": 3, "bend": 90, "axis": [0, 0, 1]},
///              {"bone": "branch2.1", "turn": 20, "axis": [1, 0, 0]},
///              {"near": [0.1, 0.8, 0.2], "twist": 30, "stretch": 1.2}]}
/// `near` means the branch nearest to that point. Angles are in degrees, counter-clockwise seen
/// against the axis. `begin` and `end`, in seconds, say when a move is done: from 0 on and for one
/// second where they are not given. Of one bone twists come first, about itself at rest; then turns
/// and bends in the order given.
/// @throws InputError that names the file and the move.
Pose read_pose(std::string_view bytes, const std::string& name, const Armature& armature);

/// Where a bone goes: stretched along itself first, then moved as a rigid body.
struct BoneMotion {
    DVec3 shift{0.0};      ///< of its head, by what stretches before it
    double stretch = 1.0;  ///< along itself
    glm::dquat turn{1, 0, 0, 0};
    DVec3 move{0.0};  ///< stretched p goes to turn * p + move
};

/// Of every bone, with all that it hangs on.
std::vector<BoneMotion> bone_motions(const Armature& armature, const Pose& pose);

}  // namespace zskel
