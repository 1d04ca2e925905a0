// Any bytes as a pose of a hub, two bones and a branch beside them, which then moves.
#include "fuzz.h"
#include "zskel/rig/pose.h"

using namespace zskel;

namespace {

Armature small_armature() {
    Armature armature;
    armature.bones = {{"root", kNone, kNone, {0, 0, 0}, {0, 0, 0}, 0.1},
                      {"branch0.0", 0, 0, {0, 0, 0}, {1, 0, 0}, 0.1},
                      {"branch0.1", 1, 0, {1, 0, 0}, {2, 0, 0}, 0.1},
                      {"branch1.0", 0, 1, {0, 0, 0}, {0, 1, 0}, 0.1}};
    return armature;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Armature armature = small_armature();
    fuzz::answer([&] {
        const Pose pose = read_pose(fuzz::text_of(data, size), "pose", armature);
        for (const double share : {0.0, 0.3, 1.0}) {
            const auto motions = bone_motions(armature, pose_at(pose, share * duration(pose)));
            fuzz::require(motions.size() == armature.bones.size(), "every bone has a motion");
        }
    });
    return 0;
}
