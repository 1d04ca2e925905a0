#include "zskel/rig/joints.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/shapes.h"
#include "zskel/rig/skinning.h"

using namespace zskel;

namespace {

constexpr double kRadius = 0.1;

// A tube along x from 0 to 2, its axis beside the bones' line; a hub, and bones from 0 over 1 to 2.
struct Tube {
    explicit Tube(double off_axis) : mesh(test::cylinder(kRadius, 2.0, 48, 81)) {
        for (DVec3& p : mesh.positions) {
            p = {p.z + 1.0, p.y + off_axis, -p.x};
            const double second = std::clamp((p.x - 0.9) / 0.2, 0.0, 1.0);
            weights.push_back({{1, static_cast<float>(1.0 - second)},  // the strongest first
                               {2, static_cast<float>(second)}});
            if (second > 0.5) std::swap(weights.back()[0], weights.back()[1]);
        }
        armature.bones = {{"root", kNone, kNone, {0, 0, 0}, {0, 0, 0}, kRadius},
                          {"branch0.0", 0, 0, {0, 0, 0}, {1, 0, 0}, kRadius},
                          {"branch0.1", 1, 0, {1, 0, 0}, {2, 0, 0}, kRadius}};
    }

    double volume_change(const DVec3& axis) const {
        Move move;
        move.bones = {2};
        move.axis = axis;
        move.bend = std::numbers::pi / 4.0;
        const auto motions = bone_motions(armature, {move});
        const auto deformed = deform(mesh, armature, weights, motions, Skinning::DualQuaternion);
        return measure_deformation(mesh, deformed, weights, motions).volume_change.value();
    }

    Mesh mesh;
    std::vector<std::vector<Influence>> weights;
    Armature armature;
};

}  // namespace

TEST_CASE("centre_joints: a joint goes to the centroid of the cut, and bends keep the volume") {
    Tube tube(0.04);
    CHECK(std::abs(tube.volume_change({0, 0, 1})) > 0.01);  // about pi/4 of 0.04 times the section
    centre_joints(tube.mesh, tube.weights, tube.armature);
    const std::vector<Bone>& bones = tube.armature.bones;
    CHECK(glm::distance(bones[2].head, {1, 0.04, 0}) < 1e-6);
    CHECK(bones[1].tail == bones[2].head);
    CHECK(bones[2].tail == DVec3(2, 0, 0));
    for (const DVec3& still : {bones[0].head, bones[0].tail, bones[1].head})
        CHECK(still == DVec3(0.0));  // all hangs on them: no cut
    for (const DVec3& axis : {DVec3(0, 0, 1), DVec3(0, 1, 0), glm::normalize(DVec3(0, 1, -1))})
        CHECK(std::abs(tube.volume_change(axis)) < 1e-3);
}

TEST_CASE("centre_joints: what is centred or too far off stays") {
    const auto moved = [](Tube tube) {
        const DVec3 before = tube.armature.bones[2].head;
        centre_joints(tube.mesh, tube.weights, tube.armature);
        return glm::distance(tube.armature.bones[2].head, before);
    };
    CHECK(moved(Tube(0.0)) < 1e-6);
    CHECK(moved(Tube(0.7 * kRadius)) == doctest::Approx(0.7 * kRadius));
    CHECK(moved(Tube(0.8 * kRadius)) == 0.0);
}

TEST_CASE("centre_joints: a tail where several bones start stays with the skeleton") {
    Tube tube(0.04);
    tube.armature.bones.push_back({"branch1.0", 1, 1, {1, 0, 0}, {1, 1, 0}, kRadius});
    centre_joints(tube.mesh, tube.weights, tube.armature);
    CHECK(tube.armature.bones[1].tail == DVec3(1, 0, 0));
    CHECK(tube.armature.bones[2].head.y == doctest::Approx(0.04));
    CHECK(tube.armature.bones[3].head == DVec3(1, 0, 0));  // nothing follows it
}
