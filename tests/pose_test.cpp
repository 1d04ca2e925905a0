#include "zskel/rig/pose.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/extract.h"
#include "support/shapes.h"
#include "zskel/core/error.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/mesh/self_intersections.h"
#include "zskel/rig/joints.h"
#include "zskel/rig/skinning.h"

using namespace zskel;

namespace {

constexpr double kRight = std::numbers::pi / 2.0;

// A hub, and two bones along x, from 0 over 1 to 2.
Armature two_bones() {
    Armature armature;
    armature.bones = {{"root", kNone, kNone, {0, 0, 0}, {0, 0, 0}, 0.1},
                      {"branch0.0", 0, 0, {0, 0, 0}, {1, 0, 0}, 0.1},
                      {"branch0.1", 1, 0, {1, 0, 0}, {2, 0, 0}, 0.1}};
    return armature;
}

Move move_of(std::vector<std::uint32_t> bones) {
    Move move;
    move.bones = std::move(bones);
    move.axis = {0, 0, 1};
    return move;
}

DVec3 placed(const BoneMotion& motion, const DVec3& point) {
    return motion.turn * point + motion.move;
}

// A tube of radius 0.1 along x from 0 to 2, and its weights: a sharp change at 1.
Mesh tube() {
    Mesh mesh = test::cylinder(0.1, 2.0, 24, 41);
    for (DVec3& p : mesh.positions) p = {p.z + 1.0, p.y, -p.x};
    return mesh;
}
std::vector<std::vector<Influence>> tube_weights(const Mesh& mesh) {
    std::vector<std::vector<Influence>> weights;
    for (const DVec3& p : mesh.positions) {
        const auto second = static_cast<float>(glm::clamp((p.x - 0.8) / 0.4, 0.0, 1.0));
        weights.push_back(second < 1.0f ? std::vector<Influence>{{1, 1.0f - second}}
                                        : std::vector<Influence>{});
        if (second > 0.0f) weights.back().push_back({2, second});
    }
    return weights;
}

}  // namespace

TEST_CASE("bone_motions: a bend is shared out over a branch, a turn is at its start") {
    Move bend = move_of({1, 2});
    bend.bend = kRight;
    const auto bent = bone_motions(two_bones(), {bend});
    const double half = std::sqrt(0.5);
    CHECK(glm::distance(placed(bent[1], {1, 0, 0}), DVec3(half, half, 0)) < 1e-12);
    CHECK(glm::distance(placed(bent[2], {1, 0, 0}), DVec3(half, half, 0)) < 1e-12);
    CHECK(glm::distance(placed(bent[2], {2, 0, 0}), DVec3(half, half + 1, 0)) < 1e-12);

    Move turn = move_of({1, 2});
    turn.turn = kRight;
    const auto turned = bone_motions(two_bones(), {turn});
    CHECK(glm::distance(placed(turned[2], {2, 0, 0}), DVec3(0, 2, 0)) < 1e-12);
}

TEST_CASE("bone_motions: a twist leaves the axis, a stretch moves what hangs on it") {
    Move twist = move_of({1, 2});
    twist.twist = 2.0 * kRight;
    const auto twisted = bone_motions(two_bones(), {twist});
    CHECK(glm::distance(placed(twisted[2], {2, 0, 0}), DVec3(2, 0, 0)) < 1e-12);
    CHECK(glm::distance(placed(twisted[1], {1, 1, 0}), DVec3(1, 0, 1)) < 1e-12);
    CHECK(glm::distance(placed(twisted[2], {2, 1, 0}), DVec3(2, -1, 0)) < 1e-12);

    Move stretch = move_of({1});
    stretch.stretch = 1.5;
    const auto longer = bone_motions(two_bones(), {stretch});
    CHECK(glm::distance(longer[2].shift, DVec3(0.5, 0, 0)) < 1e-12);
    CHECK(longer[2].stretch == 1.0);
}

TEST_CASE("bone_motions: a twist is about the bone itself, whatever else turns it") {
    Move twist = move_of({1, 2});
    twist.twist = kRight;
    Move bend = move_of({1, 2});
    bend.bend = kRight;
    const auto straight = bone_motions(two_bones(), {bend});
    for (const Pose& pose : {Pose{twist, bend}, Pose{bend, twist}}) {
        const auto motions = bone_motions(two_bones(), pose);
        CHECK(glm::distance(placed(motions[1], {1, 0, 0}), placed(straight[1], {1, 0, 0})) < 1e-12);
        const DVec3 own = motions[2].turn * DVec3(1, 0, 0);
        CHECK(glm::distance(placed(motions[2], {2, 0, 0}), placed(motions[2], {1, 0, 0}) + own) <
              1e-12);
    }
    // Turns in the order given: x to y about z, then y to z about x.
    Move first = move_of({1});
    first.turn = kRight;
    Move second = move_of({1});
    second.axis = {1, 0, 0};
    second.turn = kRight;
    const auto turned = bone_motions(two_bones(), {first, second});
    CHECK(glm::distance(placed(turned[1], {1, 0, 0}), DVec3(0, 0, 1)) < 1e-12);
}

TEST_CASE("bone_motions: a child turns about where its stretched parent ends") {
    Move stretch = move_of({1});
    stretch.stretch = 2.0;
    Move turn = move_of({2});
    turn.turn = kRight;
    const auto motions = bone_motions(two_bones(), {stretch, turn});
    const auto weights = std::vector<std::vector<Influence>>{{{1, 1.0f}}, {{2, 1.0f}}};
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {2, 0, 0}};
    const auto out = deform(mesh, two_bones(), weights, motions, Skinning::DualQuaternion);
    CHECK(glm::distance(out[0], DVec3(2, 0, 0)) < 1e-12);
    CHECK(glm::distance(out[1], DVec3(2, 1, 0)) < 1e-12);
}

TEST_CASE("deform: between a bone at rest and one turned by 270 degrees the way is the short one") {
    Move twist = move_of({2});
    twist.twist = 3.0 * kRight;
    const auto motions = bone_motions(two_bones(), {twist});
    Mesh mesh;
    mesh.positions = {{1, 1, 0}};
    const std::vector<std::vector<Influence>> weights = {{{1, 0.5f}, {2, 0.5f}}};
    const double half = std::sqrt(0.5);
    const auto out = deform(mesh, two_bones(), weights, motions, Skinning::DualQuaternion);
    CHECK(glm::distance(out[0], DVec3(1, half, -half)) < 1e-9);
}

TEST_CASE("measure_deformation: an open surface has no volume to change") {
    const Mesh mesh = tube();
    Mesh open = mesh;
    open.triangles.resize(mesh.triangles.size() / 2);
    const auto rest = bone_motions(two_bones(), {});
    const auto weights = tube_weights(mesh);
    CHECK_FALSE(measure_deformation(open, mesh.positions, weights, rest).volume_change);
    Mesh mixed = mesh;  // half of its faces look inward; it is closed all the same
    for (std::size_t t = 0; t < mixed.triangles.size(); t += 2)
        std::swap(mixed.triangles[t].y, mixed.triangles[t].z);
    std::vector<DVec3> larger = mesh.positions;
    for (DVec3& p : larger) p *= 2.0;
    const auto change = measure_deformation(mixed, larger, weights, rest).volume_change;
    REQUIRE(change);
    CHECK(*change == doctest::Approx(7.0));
}

TEST_CASE("deform: nothing moves in the rest pose, and a stretch is exact along a tube") {
    const Mesh mesh = tube();
    const auto weights = tube_weights(mesh);
    const auto rest = bone_motions(two_bones(), {});
    for (const Skinning skinning : {Skinning::DualQuaternion, Skinning::Linear}) {
        const auto same = deform(mesh, two_bones(), weights, rest, skinning);
        for (std::size_t v = 0; v < same.size(); ++v)
            CHECK(glm::distance(same[v], mesh.positions[v]) < 1e-12);
    }
    Move stretch = move_of({1, 2});
    stretch.stretch = 1.5;
    const auto motions = bone_motions(two_bones(), {stretch});
    const auto longer = deform(mesh, two_bones(), weights, motions, Skinning::DualQuaternion);
    for (std::size_t v = 0; v < longer.size(); ++v) {
        const DVec3& p = mesh.positions[v];
        CHECK(glm::distance(longer[v], DVec3(1.5 * p.x, p.y, p.z)) < 1e-9);
    }
    const DeformMeasures measures = measure_deformation(mesh, longer, weights, motions);
    REQUIRE(measures.volume_change);
    CHECK(*measures.volume_change == doctest::Approx(0.5));
    CHECK(measures.flipped_faces == 0);
    CHECK(measures.edge_stretch_worst == doctest::Approx(1.5));
    CHECK(measures.farthest ==
          doctest::Approx(1.0 / glm::length(DVec3(2, 0.2, 0.2))).epsilon(0.01));
}

TEST_CASE("deform: where a tube is twisted dual quaternions keep its girth, the mean does not") {
    const Mesh mesh = tube();
    const auto weights = tube_weights(mesh);
    Move twist = move_of({2});
    twist.twist = 1.9 * kRight;
    const auto motions = bone_motions(two_bones(), {twist});
    const auto thinnest = [&](Skinning skinning) {
        double least = 1.0;
        for (const DVec3& p : deform(mesh, two_bones(), weights, motions, skinning)) {
            if (p.x > 0.1 && p.x < 1.9) least = std::min(least, std::hypot(p.y, p.z));
        }
        return least;
    };
    CHECK(thinnest(Skinning::DualQuaternion) == doctest::Approx(0.1));
    CHECK(thinnest(Skinning::Linear) < 0.03);
}

TEST_CASE("measure_deformation: a face that is turned against its bones is counted") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    test::add_triangle(mesh, 0, 1, 2);
    test::add_triangle(mesh, 0, 2, 3);
    const std::vector<std::vector<Influence>> weights(mesh.positions.size(), {{1, 1.0f}});
    Move turn = move_of({1, 2});
    turn.axis = {1, 0, 0};
    turn.turn = 2.0 * kRight;
    const auto motions = bone_motions(two_bones(), {turn});
    auto deformed = deform(mesh, two_bones(), weights, motions, Skinning::DualQuaternion);
    CHECK(measure_deformation(mesh, deformed, weights, motions).flipped_faces == 0);
    deformed[3] = deformed[1];  // folded over the diagonal
    deformed[3].z += 1e-3;
    CHECK(measure_deformation(mesh, deformed, weights, motions).flipped_faces == 1);
}

TEST_CASE("read_pose: by branch, by bone, by the nearest point") {
    const Pose pose = read_pose(R"({"moves": [
        {"branch": 0, "bend": 90, "axis": [0, 0, 2]},
        {"bone": "branch0.1", "twist": 45, "turn": 3, "axis": [0, -1e200, 0]},
        {"near": [1.9, 0.3, 0], "stretch": 1.25}]})",
                                "a.json", two_bones());
    REQUIRE(pose.size() == 3);
    CHECK(pose[0].bones == std::vector<std::uint32_t>{1, 2});
    CHECK(pose[0].bend == doctest::Approx(kRight));
    CHECK(pose[0].axis == DVec3(0, 0, 1));
    CHECK(pose[1].bones == std::vector<std::uint32_t>{2});
    CHECK(pose[2].bones == std::vector<std::uint32_t>{1, 2});
    CHECK(pose[1].axis == DVec3(0, -1, 0));
    CHECK(pose[2].stretch == 1.25);
}

TEST_CASE("read_pose: when moves begin and end") {
    const Pose pose = read_pose(R"({"moves": [
        {"branch": 0, "bend": 90, "axis": [0, 0, 1]},
        {"branch": 0, "stretch": 4, "begin": 2},
        {"bone": "branch0.1", "twist": 40, "begin": 1, "end": 1}]})",
                                "a.json", two_bones());
    CHECK(duration(pose) == 3.0);
    CHECK(duration({}) == 0.0);
    const auto at = [&](double seconds, double bend, double stretch, double twist) {
        INFO(seconds);
        const Pose now = pose_at(pose, seconds);
        CHECK(now[0].bend == doctest::Approx(kRight * bend));
        CHECK(now[1].stretch == doctest::Approx(stretch));
        CHECK(now[2].twist == doctest::Approx(kRight * twist));
    };
    at(0.0, 0.0, 1.0, 0.0);
    at(0.5, 0.5, 1.0, 0.0);
    at(0.999999, 1.0, 1.0, 0.0);
    at(1.0, 1.0, 1.0, 4.0 / 9.0);  // at once
    at(2.5, 1.0, 2.0, 4.0 / 9.0);
    at(3.0, 1.0, 4.0, 4.0 / 9.0);
    at(9.0, 1.0, 4.0, 4.0 / 9.0);
}

TEST_CASE("deform_skeleton: nodes go with their bones") {
    SkeletonGraph graph;
    for (const double x : {0.0, 0.5, 1.0, 2.0}) graph.nodes.push_back({{x, 0, 0}, 0.1, 0, 0.0});
    graph.edges = {{0, 1}, {1, 2}, {2, 3}};
    Armature armature = two_bones();
    armature.node_bones = {{0, 1}, {1}, {1, 2}, {2}};
    Move stretch = move_of({1});
    stretch.stretch = 2.0;
    Move turn = move_of({2});
    turn.turn = kRight;
    const SkeletonGraph posed =
        deform_skeleton(graph, armature, bone_motions(armature, {stretch, turn}));
    CHECK(posed.edges.size() == 3);
    CHECK(glm::distance(posed.nodes[0].position, DVec3(0, 0, 0)) < 1e-12);
    CHECK(glm::distance(posed.nodes[1].position, DVec3(1, 0, 0)) < 1e-12);
    CHECK(glm::distance(posed.nodes[2].position, DVec3(2, 0, 0)) < 1e-12);
    CHECK(glm::distance(posed.nodes[3].position, DVec3(2, 1, 0)) < 1e-12);
}

TEST_CASE("measure_deformation: faces that pass through others are counted, and those at rest") {
    Mesh mesh = test::cube();
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    const std::vector<Triangle> once = mesh.triangles;
    for (const Triangle& t : once) test::add_triangle(mesh, t.x + count, t.y + count, t.z + count);
    for (std::uint32_t v = 0; v < count; ++v) {
        const DVec3 there = mesh.positions[v] * 0.9 + DVec3(3, 0, 0);
        mesh.positions.push_back(there);
    }
    const std::vector<std::vector<Influence>> weights(mesh.positions.size(), {{1, 1.0f}});
    const auto rest = bone_motions(two_bones(), {});
    std::vector<DVec3> nearer = mesh.positions;
    for (std::size_t v = count; v < nearer.size(); ++v) nearer[v].x -= 2.5;
    const DeformMeasures m = measure_deformation(mesh, nearer, weights, rest);
    CHECK(m.crossing_at_rest == 0);
    // One side of the first, two triangles, is cut by the four sides of the second round it.
    CHECK(m.crossing_faces == 10);
    Mesh crossed = mesh;
    crossed.positions = nearer;
    CHECK(measure_deformation(crossed, mesh.positions, weights, rest).crossing_at_rest == 10);
    CHECK(measure_deformation(crossed, mesh.positions, weights, rest).crossing_faces == 0);
}

TEST_CASE("crossing_triangles: at a common corner, but not at a common edge or in one plane") {
    const std::vector<DVec3> p = {{0, 0, 0},     {2, 0, 0},  {0, 2, 0}, {0.5, 0.5, -1},
                                  {0.5, 0.5, 1}, {1, -1, 0}, {2, 2, 0}};
    const auto crossing = [&](const std::vector<Triangle>& triangles) {
        return crossing_triangles(p, triangles)->size();
    };
    CHECK(crossing({}) == 0);
    CHECK(crossing({{0, 1, 2}, {0, 3, 4}}) == 2);
    CHECK(crossing({{0, 1, 2}, {1, 2, 4}}) == 0);
    CHECK(crossing({{0, 1, 2}, {0, 5, 6}}) == 0);
    CHECK(crossing({{0, 1, 2}, {5, 3, 4}}) == 2);
    CHECK(crossing({{0, 1, 2}, {5, 3, 4}, {6, 3, 4}}) == 3);
    const Mesh ball = test::sphere(0.5, 3);
    CHECK(crossing_triangles(ball.positions, ball.triangles, bearable_pairs(ball.triangles.size()))
              ->empty());
    CHECK_FALSE(crossing_triangles(ball.positions, ball.triangles, 100).has_value());
}

TEST_CASE("read_pose: what is wrong is named, with its place") {
    const auto refused = [](const char* text, const char* piece) {
        INFO(text);
        CHECK_THROWS_WITH_AS(read_pose(text, "a.json", two_bones()), doctest::Contains(piece),
                             InputError);
    };
    refused("{", "a.json: no JSON");
    refused("{}", "moves");
    refused(R"({"moves": [{"bend": 3}]})", "a.json: moves[0]");
    refused(R"({"moves": [{"branch": 0, "bone": "branch0.0"}]})", "one of branch, bone and near");
    refused(R"({"moves": [{"branch": 7}]})", "moves[0]: branch: '7'");
    refused(R"({"moves": [{"branch": -1}]})", "branch");
    refused(R"({"moves": [{"bone": "leg"}]})", "bone");
    refused(R"({"moves": [{"near": [1, 2]}]})", "three numbers");
    refused(R"({"moves": [{"branch": 0, "begin": 1}]})", "turn, bend, twist or stretch");
    refused(R"({"moves": [{"branch": 0, "bend": 30}]})", "axis");
    refused(R"({"moves": [{"branch": 0, "bend": 30, "axis": [0, 0, 0]}]})", "a direction");
    refused(R"({"moves": [{"branch": 0, "bend": "x", "axis": [0, 0, 1]}]})", "bend");
    refused(R"({"moves": [{"branch": 0, "stretch": 0}]})", "from 0.001 to 1000");
    refused(R"({"moves": [{"branch": 0, "stretch": 1e308}]})", "from 0.001 to 1000");
    refused(R"({"moves": [{"branch": 0, "twist": 3, "begin": -1}]})", "begin");
    refused(R"({"moves": [{"branch": 0, "twist": 3, "begin": 2, "end": 1}]})", "end");
    refused(R"({"moves": [{"branch": 0, "twist": 3, "end": 1e9}]})", "to 3600");
    Armature ball;
    ball.bones = {two_bones().bones[0]};
    CHECK_THROWS_WITH_AS(
        read_pose(R"({"moves": [{"near": [0, 0, 0], "twist": 3}]})", "a.json", ball),
        doctest::Contains("near a branch with bones"), InputError);
    refused(R"({"moves": [{"branch": 0, "bent": 30}]})", "bent");
}

TEST_CASE("deform: each limb of our creatures bent by 45 degrees, and no other goes along") {
    std::string name;
    std::size_t expected_limbs = 0;
    const auto creature = [&](const char* model, std::size_t limbs) {
        SUBCASE(model) {
            name = model;
            expected_limbs = limbs;
        }
    };
    creature("horse", 8);
    creature("bull", 10);
    creature("frog", 15);
    creature("mouse", 8);
    creature("cobra", 1);
    creature("octopus", 9);
    creature("hand", 6);
    creature("plant", 15);
    creature("y", 3);
    if (name.empty()) return;
    const Mesh mesh = read_mesh(std::string(ZSKEL_MODELS "/") + name + ".obj");
    const ExtractResult result = test::extract(mesh, {}, 10);
    Armature armature = build_armature(result.graph, mesh.triangles, {});
    const auto weights = skin_weights(mesh, result.graph, armature, {});
    centre_joints(mesh, weights, armature);
    const std::vector<Branch> branches = find_branches(result.graph);
    const auto is_end = [&](std::size_t b) {
        return b < branches.size() &&
               (branches[b].start_degree == 1 || branches[b].stop_degree == 1);
    };
    std::size_t limbs = 0;
    double most_volume = 0.0;
    std::size_t most_flipped = 0;
    double most_moved = 0.0;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        if (!is_end(b)) continue;
        ++limbs;
        for (const DVec3& axis : {DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)}) {
            Move bend;
            for (std::uint32_t bone = 0; bone < armature.bones.size(); ++bone) {
                if (armature.bones[bone].branch == b) bend.bones.push_back(bone);
            }
            REQUIRE_FALSE(bend.bones.empty());
            bend.axis = axis;
            bend.bend = 0.5 * kRight;
            const auto motions = bone_motions(armature, {bend});
            const auto deformed =
                deform(mesh, armature, weights, motions, Skinning::DualQuaternion);
            const DeformMeasures m = measure_deformation(mesh, deformed, weights, motions);
            INFO("branch " << b);
            CHECK(std::abs(m.volume_change.value()) <= 0.01);
            CHECK(static_cast<double>(m.flipped_faces) <=
                  0.001 * static_cast<double>(mesh.triangles.size()));
            double others = 0.0;
            for (std::size_t v = 0; v < deformed.size(); ++v) {
                const std::uint32_t own = armature.bones[weights[v].front().bone].branch;
                if (own == b || !is_end(own)) continue;
                others = std::max(others, glm::distance(deformed[v], mesh.positions[v]));
            }
            others /= box_of(mesh.positions).diagonal();
            CHECK(others <= 0.005);
            most_volume = std::max(most_volume, std::abs(m.volume_change.value()));
            most_flipped = std::max(most_flipped, m.flipped_faces);
            most_moved = std::max(most_moved, others);
        }
    }
    MESSAGE(name, ": volume changed by ", most_volume, ", faces flipped ", most_flipped,
            ", others moved by ", most_moved, " of the diagonal, at most");
    CHECK(limbs == expected_limbs);
}
