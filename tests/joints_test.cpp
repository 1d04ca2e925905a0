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
    CHECK(glm::distance(joint_of(bones[2]), {1, 0.04, 0}) < 1e-6);
    CHECK(bones[2].head == DVec3(1, 0, 0));
    for (const std::uint32_t all_hangs_on : {0u, 1u})
        CHECK(bones[all_hangs_on].to_joint == DVec3(0.0));
    for (const DVec3& axis : {DVec3(0, 0, 1), DVec3(0, 1, 0), glm::normalize(DVec3(0, 1, -1))})
        CHECK(std::abs(tube.volume_change(axis)) < 1e-3);
}

TEST_CASE("centre_joints: what is centred or too far off stays") {
    const auto moved = [](Tube tube) {
        centre_joints(tube.mesh, tube.weights, tube.armature);
        return glm::length(tube.armature.bones[2].to_joint);
    };
    CHECK(moved(Tube(0.0)) < 1e-6);
    CHECK(moved(Tube(0.7 * kRadius)) == doctest::Approx(0.7 * kRadius));
    CHECK(moved(Tube(0.8 * kRadius)) == 0.0);
}

TEST_CASE("centre_joints: openings count as capped, turned faces as they should be") {
    Tube open(0.04);
    std::erase_if(open.mesh.triangles, [&](const Triangle& t) {  // beyond 1.95: no tip
        return std::min({open.mesh.positions[t.x].x, open.mesh.positions[t.y].x,
                         open.mesh.positions[t.z].x}) > 1.95;
    });
    Tube turned(0.04);
    for (std::size_t t = 0; t < turned.mesh.triangles.size(); ++t) {
        if (t % 7 < 3) std::swap(turned.mesh.triangles[t].x, turned.mesh.triangles[t].y);
    }
    for (Tube* tube : {&open, &turned}) {
        centre_joints(tube->mesh, tube->weights, tube->armature);
        CHECK(glm::distance(joint_of(tube->armature.bones[2]), {1, 0.04, 0}) < 1e-6);
    }
}

TEST_CASE("centre_joints: twists go about the bone's direction, through its joint") {
    Tube tube(0.04);
    centre_joints(tube.mesh, tube.weights, tube.armature);
    Move twist;
    twist.bones = {2};
    twist.twist = std::numbers::pi / 2.0;
    const auto motions = bone_motions(tube.armature, {twist});
    const DVec3 top = motions[2].turn * DVec3(2, 0.04, 0.1) + motions[2].move;
    CHECK(glm::distance(top, {2, 0.04 - 0.1, 0}) < 1e-6);
}
