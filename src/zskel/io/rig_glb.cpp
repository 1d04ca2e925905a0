#include "zskel/io/rig_glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "zskel/core/error.h"
#include "zskel/io/gltf_builder.h"
#include "zskel/mesh/bounds.h"

namespace zskel {
namespace {

using Json = GltfBuilder::Json;

// Farther from the origin than so many diagonals 32-bit positions lose what a viewer shows.
constexpr double kMostDiagonalsAway = 16.0;

// Joints in the file's order: bones, ends, what stretches; each with what it hangs on. Its place at
// rest is global; only what stretches is turned there, its x axis along the bone.
struct Joint {
    enum class Kind { Bone, End, Stretch };
    Kind kind = Kind::Bone;
    std::string name;
    DVec3 position{0.0};
    std::uint32_t parent = kNone;
    glm::dquat turn{1, 0, 0, 0};
};

struct Joints {
    std::vector<Joint> all;
    std::vector<std::uint32_t> of_bone;  // that its vertices follow
};

bool stretches(const std::vector<RigKey>& keys, std::size_t bone) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](const RigKey& key) { return key.motions[bone].stretch != 1.0; });
}

Joints joints_of(const Armature& armature, const std::vector<RigKey>& keys) {
    Joints joints;
    for (const Bone& bone : armature.bones)
        joints.all.push_back({Joint::Kind::Bone, bone.name, joint_of(bone), bone.parent});
    for (const std::uint32_t b : last_bones(armature))
        joints.all.push_back(
            {Joint::Kind::End, armature.bones[b].name + "_end", armature.bones[b].tail, b});
    for (std::uint32_t b = 0; b < armature.bones.size(); ++b) {
        const Bone& bone = armature.bones[b];
        joints.of_bone.push_back(b);
        if (bone.head == bone.tail || !stretches(keys, b)) continue;
        joints.of_bone.back() = static_cast<std::uint32_t>(joints.all.size());
        joints.all.push_back(
            {Joint::Kind::Stretch, bone.name + "_stretch", bone.head, b,
             glm::dquat(DVec3(1.0, 0.0, 0.0), glm::normalize(bone.tail - bone.head))});
    }
    return joints;
}

Json vector_of(const DVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Json quaternion_of(const glm::dquat& q) {
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
            static_cast<float>(q.w)};
}

// Weighted by area; of a vertex without faces any direction will do.
std::vector<DVec3> normals_of(const Mesh& mesh) {
    std::vector<DVec3> normals(mesh.positions.size(), DVec3(0.0));
    for (const Triangle& t : mesh.triangles) {
        const DVec3& a = mesh.positions[t.x];
        const DVec3 cross = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        for (int k = 0; k < 3; ++k) normals[t[k]] += cross;
    }
    for (DVec3& n : normals) {
        const double length = glm::length(n);
        n = length > 0.0 ? n / length : DVec3(0.0, 0.0, 1.0);
    }
    return normals;
}

Json node_tree(const std::vector<Joint>& joints, std::size_t first_joint) {
    Json nodes = Json::array();
    std::vector<Json> children(joints.size(), Json::array());
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const Joint& joint = joints[j];
        const bool is_root = joint.parent == kNone;
        if (!is_root) children[joint.parent].push_back(first_joint + j);
        const DVec3 from = is_root ? DVec3(0.0) : joints[joint.parent].position;
        nodes.push_back({{"name", joint.name}, {"translation", vector_of(joint.position - from)}});
        if (joint.turn != glm::dquat(1, 0, 0, 0)) nodes[j]["rotation"] = quaternion_of(joint.turn);
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (!children[j].empty()) nodes[j]["children"] = children[j];
    }
    return nodes;
}

// Gathers the channels of an animation.
class Animation {
  public:
    Animation(GltfBuilder& builder, const std::vector<RigKey>& keys) : builder_(builder) {
        std::vector<double> seconds;
        for (const RigKey& key : keys) seconds.push_back(key.seconds);
        times_ = builder.add_times(seconds);
    }
    void turn(std::size_t node, const std::vector<glm::dquat>& turns) {
        add(node, "rotation", builder_.add_turns(turns));
    }
    void move(std::size_t node, const std::vector<DVec3>& places) {
        add(node, "translation", builder_.add_places(places));
    }
    void scale(std::size_t node, const std::vector<DVec3>& factors) {
        add(node, "scale", builder_.add_places(factors));
    }
    Json finish() const {
        return {{"name", "pose"}, {"channels", channels_}, {"samplers", samplers_}};
    }

  private:
    void add(std::size_t node, const char* path, std::size_t values) {
        channels_.push_back(
            {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
        samplers_.push_back({{"input", times_}, {"output", values}});
    }

    GltfBuilder& builder_;
    std::size_t times_ = 0;
    Json channels_ = Json::array();
    Json samplers_ = Json::array();
};

// Every joint's way in its parent's axes. Bones are rigid; one that is longer pushes on what hangs
// on it.
Json animation_of(GltfBuilder& builder, const Armature& armature, const Joints& joints,
                  const std::vector<RigKey>& keys, std::size_t first_joint) {
    Animation animation(builder, keys);
    const auto end_shift = [&](const BoneMotion& motion, std::uint32_t bone) {
        const Bone& b = armature.bones[bone];
        return motion.shift + (b.tail - b.head) * (motion.stretch - 1.0);
    };
    for (std::uint32_t j = 0; j < joints.all.size(); ++j) {
        const Joint& joint = joints.all[j];
        std::vector<glm::dquat> turns;
        std::vector<DVec3> places;
        std::vector<DVec3> factors;
        for (const RigKey& key : keys) {
            BoneMotion before;
            if (joint.parent != kNone) before = key.motions[joint.parent];
            const DVec3 from = joint.parent == kNone
                                   ? DVec3(0.0)
                                   : joints.all[joint.parent].position + before.shift;
            if (joint.kind == Joint::Kind::Bone) {
                const BoneMotion& motion = key.motions[j];
                const DVec3 place = motion.turn * (joint.position + motion.shift) + motion.move;
                const glm::dquat back = glm::conjugate(before.turn);
                turns.push_back(back * motion.turn);
                places.push_back(back * (place - before.move) - from);
            } else if (joint.kind == Joint::Kind::End) {
                places.push_back(joint.position + end_shift(before, joint.parent) - from);
            } else {
                factors.emplace_back(before.stretch, 1.0, 1.0);
            }
        }
        const std::size_t node = first_joint + j;
        if (!turns.empty()) animation.turn(node, turns);
        if (!places.empty()) animation.move(node, places);
        if (!factors.empty()) animation.scale(node, factors);
    }
    return animation.finish();
}

// What the file's numbers are counted from: zero, or the middle of a model that lies far from it.
DVec3 base_of(const Mesh& mesh) {
    const Box box = box_of(mesh.positions);
    const DVec3 middle = 0.5 * (box.low + box.high);
    return glm::length(middle) > kMostDiagonalsAway * box.diagonal() ? middle : DVec3(0.0);
}

std::string write_about_origin(const Mesh& mesh, const Armature& armature,
                               const std::vector<std::vector<Influence>>& weights,
                               const std::vector<RigKey>& keys, const std::string& origin,
                               const DVec3& base) {
    const Joints joints = joints_of(armature, keys);
    if (joints.all.size() > std::numeric_limits<std::uint16_t>::max()) {
        throw InputError(
            fmt::format("{}: {} joints are more than a GLB file can number; "
                        "fewer bones are needed",
                        mesh.name, joints.all.size()));
    }
    std::vector<std::array<std::uint16_t, 4>> vertex_joints(weights.size());
    std::vector<std::array<float, 4>> vertex_weights(weights.size());
    for (std::size_t v = 0; v < weights.size(); ++v) {
        const std::size_t count = std::min<std::size_t>(weights[v].size(), 4);
        float sum = 0.0f;
        for (std::size_t k = 0; k < count; ++k) sum += weights[v][k].weight;
        for (std::size_t k = 0; k < count; ++k) {
            vertex_joints[v][k] = static_cast<std::uint16_t>(joints.of_bone[weights[v][k].bone]);
            vertex_weights[v][k] = weights[v][k].weight / sum;
        }
    }
    std::vector<std::uint32_t> corners;
    for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
    std::vector<glm::dmat4> to_joints;
    for (const Joint& joint : joints.all) {
        to_joints.push_back(
            glm::translate(glm::mat4_cast(glm::conjugate(joint.turn)), -joint.position));
    }

    GltfBuilder builder;
    const Json primitive{{"attributes",
                          {{"POSITION", builder.add_positions(mesh.positions)},
                           {"NORMAL", builder.add_directions(normals_of(mesh))},
                           {"JOINTS_0", builder.add_joints(vertex_joints)},
                           {"WEIGHTS_0", builder.add_weights(vertex_weights)}}},
                         {"indices", builder.add_indices(corners)},
                         {"mode", static_cast<int>(GltfBuilder::PrimitiveMode::Triangles)}};
    // Node 0 is the mesh, 1 what holds the joints.
    constexpr std::size_t kFirstJoint = 2;
    Json nodes = Json::array({{{"name", "model"}, {"mesh", 0}, {"skin", 0}}});
    Json hangers = Json::array();
    for (std::size_t b = 0; b < armature.bones.size(); ++b) {
        if (armature.bones[b].parent == kNone) hangers.push_back(kFirstJoint + b);
    }
    nodes.push_back({{"name", "armature"}, {"children", hangers}});
    if (base != DVec3(0.0)) nodes.back()["translation"] = {base.x, base.y, base.z};
    for (Json& node : node_tree(joints.all, kFirstJoint)) nodes.push_back(std::move(node));
    Json numbers = Json::array();
    for (std::size_t j = 0; j < joints.all.size(); ++j) numbers.push_back(kFirstJoint + j);
    Json document{{"scenes", {{{"nodes", {0, 1}}}}},
                  {"nodes", nodes},
                  {"meshes", {{{"primitives", {primitive}}, {"name", "model"}}}},
                  {"skins",
                   {{{"name", "armature"},
                     {"skeleton", 1},
                     {"joints", numbers},
                     {"inverseBindMatrices", builder.add_matrices(to_joints)}}}}};
    if (!keys.empty())
        document["animations"] = {animation_of(builder, armature, joints, keys, kFirstJoint)};
    return builder.finish(std::move(document), origin, GltfContainer::Binary);
}

}  // namespace

std::string write_rig_glb(const Mesh& mesh, const Armature& armature,
                          const std::vector<std::vector<Influence>>& weights,
                          const std::vector<RigKey>& keys, const std::string& origin) {
    const DVec3 base = base_of(mesh);
    if (base == DVec3(0.0)) return write_about_origin(mesh, armature, weights, keys, origin, base);
    Mesh near_mesh = mesh;
    for (DVec3& p : near_mesh.positions) p -= base;
    Armature near_armature = armature;
    for (Bone& bone : near_armature.bones) {
        bone.head -= base;
        bone.tail -= base;
    }
    std::vector<RigKey> near_keys = keys;
    for (RigKey& key : near_keys) {
        for (BoneMotion& motion : key.motions) motion.move += motion.turn * base - base;
    }
    return write_about_origin(near_mesh, near_armature, weights, near_keys, origin, base);
}

}  // namespace zskel
