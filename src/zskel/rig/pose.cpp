#include "zskel/rig/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "zskel/core/error.h"
#include "zskel/io/json_place.h"

namespace zskel {
namespace {

constexpr double kLeastStretch = 1e-3;
constexpr double kLongest = 3600.0;
constexpr std::array<const char*, 3> kTargets = {"branch", "bone", "near"};
constexpr std::array<const char*, 4> kMotions = {"turn", "bend", "twist", "stretch"};
constexpr std::array<const char*, 3> kDetails = {"axis", "begin", "end"};

std::vector<std::uint32_t> bones_of_branch(const Armature& armature, std::uint32_t branch) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t b = 0; b < armature.bones.size(); ++b) {
        if (armature.bones[b].branch == branch) out.push_back(b);
    }
    return out;
}

// Hubs are on no branch: they are meant by their names only.
std::uint32_t branch_nearest_to(const Armature& armature, const DVec3& point) {
    std::uint32_t branch = kNone;
    double least = std::numeric_limits<double>::infinity();
    for (const Bone& bone : armature.bones) {
        if (bone.branch == kNone || !(distance_to(bone, point) < least)) continue;
        least = distance_to(bone, point);
        branch = bone.branch;
    }
    return branch;
}

std::vector<std::uint32_t> bones_meant(const JsonPlace& entry, const Armature& armature) {
    if (entry.has("bone")) {
        const JsonPlace name = entry.at("bone");
        for (std::uint32_t b = 0; b < armature.bones.size(); ++b) {
            if (name.value() == armature.bones[b].name) return {b};
        }
        name.fail("the name of a bone");
    }
    const bool is_near = entry.has("near");
    const JsonPlace place = entry.at(is_near ? "near" : "branch");
    const std::uint32_t branch =
        is_near ? branch_nearest_to(armature, place.point()) : place.count();
    std::vector<std::uint32_t> bones = bones_of_branch(armature, branch);
    if (branch == kNone || bones.empty())
        place.fail(is_near ? "near a branch with bones" : "the number of a branch with bones");
    return bones;
}

double radians_at(const JsonPlace& entry, const char* key) {
    return entry.has(key) ? glm::radians(entry.at(key).number()) : 0.0;
}

Move read_move(const JsonPlace& entry, const Armature& armature) {
    std::size_t targets = 0;
    for (const char* key : kTargets) targets += entry.has(key) ? 1 : 0;
    if (targets != 1) entry.fail("a move with one of branch, bone and near");
    for (const auto& item : entry.value().items()) {
        const auto is_key = [&](const char* known) { return item.key() == known; };
        if (std::ranges::none_of(kTargets, is_key) && std::ranges::none_of(kMotions, is_key) &&
            std::ranges::none_of(kDetails, is_key))
            entry.fail("a move: it knows turn, bend, twist, stretch, axis, begin and end, not " +
                       zskel::quoted(item.key()));
    }
    Move move;
    move.bones = bones_meant(entry, armature);
    if (std::ranges::none_of(kMotions, [&](const char* key) { return entry.has(key); }))
        entry.fail("a move with turn, bend, twist or stretch");
    move.turn = radians_at(entry, "turn");
    move.bend = radians_at(entry, "bend");
    move.twist = radians_at(entry, "twist");
    if (entry.has("stretch")) {
        move.stretch = entry.at("stretch").number();
        if (!(move.stretch >= kLeastStretch && move.stretch <= 1.0 / kLeastStretch))
            entry.at("stretch").fail("from 0.001 to 1000");
    }
    if (entry.has("turn") || entry.has("bend")) {
        const JsonPlace axis = entry.at("axis");
        move.axis = axis.point();
        const double largest =
            std::max({std::abs(move.axis.x), std::abs(move.axis.y), std::abs(move.axis.z)});
        if (!(largest > 0.0)) axis.fail("a direction");
        move.axis = glm::normalize(move.axis / largest);
    }
    if (entry.has("begin")) {
        move.begin = entry.at("begin").number();
        if (!(move.begin >= 0.0 && move.begin <= kLongest))
            entry.at("begin").fail("seconds, from 0 to 3600");
    }
    move.end = move.begin + 1.0;
    if (entry.has("end")) {
        move.end = entry.at("end").number();
        if (!(move.end >= move.begin && move.end <= kLongest))
            entry.at("end").fail("seconds, from its begin to 3600");
    }
    return move;
}

}  // namespace

Pose read_pose(std::string_view bytes, const std::string& name, const Armature& armature) {
    const nlohmann::json data = parse_json(bytes, name);
    const JsonPlace moves = JsonPlace(data, name).at("moves");
    Pose pose;
    for (std::size_t i = 0; i < moves.array_size(); ++i)
        pose.push_back(read_move(moves.at(i), armature));
    return pose;
}

double duration(const Pose& pose) {
    double out = 0.0;
    for (const Move& move : pose) out = std::max(out, move.end);
    return out;
}

Pose pose_at(const Pose& pose, double seconds) {
    Pose out = pose;
    for (Move& move : out) {
        const double way = move.end - move.begin;
        double done = seconds >= move.end ? 1.0 : 0.0;
        if (way > 0.0) done = glm::clamp((seconds - move.begin) / way, 0.0, 1.0);
        const double share = done * done * (3.0 - 2.0 * done);
        move.turn *= share;
        move.bend *= share;
        move.twist *= share;
        move.stretch = std::pow(move.stretch, share);
    }
    return out;
}

std::vector<BoneMotion> bone_motions(const Armature& armature, const Pose& pose) {
    const std::size_t count = armature.bones.size();
    std::vector<BoneMotion> motions(count);
    std::vector<glm::dquat> twists(count, glm::dquat(1, 0, 0, 0));
    std::vector<glm::dquat> turns = twists;
    for (const Move& move : pose) {
        const double share = 1.0 / static_cast<double>(move.bones.size());
        for (std::size_t i = 0; i < move.bones.size(); ++i) {
            const std::uint32_t b = move.bones[i];
            const Bone& bone = armature.bones[b];
            motions[b].stretch *= move.stretch;
            const double about_axis = (i == 0 ? move.turn : 0.0) + move.bend * share;
            if (about_axis != 0.0) turns[b] = glm::angleAxis(about_axis, move.axis) * turns[b];
            const DVec3 along = bone.tail - bone.head;
            if (move.twist != 0.0 && glm::length(along) > 0.0)
                twists[b] = glm::angleAxis(move.twist * share, glm::normalize(along)) * twists[b];
        }
    }
    for (std::size_t b = 0; b < count; ++b) {
        const Bone& bone = armature.bones[b];
        BoneMotion& motion = motions[b];
        glm::dquat before(1, 0, 0, 0);
        DVec3 moved_before(0.0);
        if (bone.parent != kNone) {
            const Bone& parent = armature.bones[bone.parent];
            const BoneMotion& of_parent = motions[bone.parent];
            motion.shift =
                of_parent.shift + (parent.tail - parent.head) *
                                      (share_along(parent, bone.head) * (of_parent.stretch - 1.0));
            before = of_parent.turn;
            moved_before = of_parent.move;
        }
        const DVec3 joint = joint_of(bone) + motion.shift;
        motion.turn = before * turns[b] * twists[b];
        motion.move = before * joint + moved_before - motion.turn * joint;
    }
    return motions;
}

}  // namespace zskel
