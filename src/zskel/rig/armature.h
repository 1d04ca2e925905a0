#pragma once

#include <span>
#include <string>
#include <vector>

#include "zskel/skeleton/graph.h"

namespace zskel {

/// What turns as one: a straight along a branch of a skeleton, or the hub at the root of one.
struct Bone {
    std::string name;              ///< "branch3.0": of `find_branches`, and the number along it;
                                   ///< "root" for a hub, with its number where there are several
    std::uint32_t parent = kNone;  ///< that it hangs on; kNone: a hub
    std::uint32_t branch = kNone;  ///< of `find_branches`; kNone: a hub
    DVec3 head{0.0};               ///< where it starts, model space
    DVec3 tail{0.0};               ///< where it ends; a hub has no length
    double radius = 0.0;           ///< mean of the skeleton's along it
    DVec3 to_joint{0.0};           ///< from its head to where it turns; see `centre_joints`
};

/// Where a loop of the skeleton was opened, since bones form trees.
struct LoopCut {
    DVec3 position{0.0};
    std::uint32_t bone = 0;   ///< that ends there, from the one side
    std::uint32_t other = 0;  ///< and from the other
};

/// The bones of a skeleton, as trees.
struct Armature {
    std::vector<Bone> bones;  ///< parents before their children; hubs first, one a component of
                              ///< the skeleton, in order of lowest nodes
    std::vector<LoopCut> cuts;
    /// Of every node of the skeleton: the bone that it lies on; at a joint all that meet there.
    std::vector<std::vector<std::uint32_t>> node_bones;
    std::size_t dropped_branches = 0;  ///< that got no bone of their own, to keep within the bound
    std::size_t stubs = 0;  ///< branches with an end that hardly leave what they hang on, and got
                            ///< none for that
};

struct ArmatureOptions {
    double bend_radii = 0.5;     ///< a bone lies no farther than this from its branch, in radii
    double longest_radii = 5.0;  ///< and is about so long at most: bones end at nodes
    std::size_t max_bones = 0;   ///< hubs, bones and ends of limbs together; 0: no bound
};

/// Where a bone turns, model space.
DVec3 joint_of(const Bone& bone);

/// Where a point lies along a bone: 0 at its head, 1 at its tail; 0 for a hub.
double share_along(const Bone& bone, const DVec3& point);

/// From a point to the nearest of a bone.
double distance_to(const Bone& bone, const DVec3& point);

/// The bones on which none hangs; hubs are not among them.
std::vector<std::uint32_t> last_bones(const Armature& armature);

/// Turns a skeleton into bones. The root of each component is its thickest junction (its thicker
/// end where it has none); a loop is opened where the ways from the root round it meet, and the two
/// parts of a branch that is cut so both start at its ends. The first bone of a branch starts where
/// a limb of its own does, as a hip lies off the spine and a knuckle off the wrist: at its first
/// node outside the ball at its junction from which on its patches of the surface touch none of the
/// branches that start there or end there. What is before it moves with what the branch hangs on.
/// To keep within `max_bones` bones are made coarser; then the shortest end branches get none of
/// their own, and move so too.
/// @param triangles  of the mesh, for its patches (`vertex_node`); none: only balls count.
/// @throws UsageError when there are more components than `max_bones`.
Armature build_armature(const SkeletonGraph& graph, std::span<const Triangle> triangles,
                        const ArmatureOptions& options);

}  // namespace zskel
