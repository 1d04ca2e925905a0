#include "zskel/io/rig_glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "zskel/core/error.h"
#include "zskel/io/gltf_builder.h"

namespace zskel {
namespace {

using Json = GltfBuilder::Json;

// Joints in the file's order: bones, then ends; each with what it hangs on.
struct Joint {
    std::string name;
    DVec3 position{0.0};
    std::uint32_t parent = kNone;
};

std::vector<Joint> joints_of(const Armature& armature) {
    std::vector<Joint> joints;
    for (const Bone& bone : armature.bones) joints.push_back({bone.name, bone.head, bone.parent});
    for (const std::uint32_t b : last_bones(armature))
        joints.push_back({armature.bones[b].name + "_end", armature.bones[b].tail, b});
    return joints;
}

Json vector_of(const DVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
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
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (!children[j].empty()) nodes[j]["children"] = children[j];
    }
    return nodes;
}

}  // namespace

std::string write_rig_glb(const Mesh& mesh, const Armature& armature,
                          const std::vector<std::vector<Influence>>& weights,
                          const std::string& origin) {
    const std::vector<Joint> joints = joints_of(armature);
    if (joints.size() > std::numeric_limits<std::uint16_t>::max()) {
        throw InputError(
            fmt::format("{}: {} joints are more than a GLB file can number; "
                        "fewer bones are needed",
                        mesh.name, joints.size()));
    }
    std::vector<std::array<std::uint16_t, 4>> vertex_joints(weights.size());
    std::vector<std::array<float, 4>> vertex_weights(weights.size());
    for (std::size_t v = 0; v < weights.size(); ++v) {
        const std::size_t count = std::min<std::size_t>(weights[v].size(), 4);
        float sum = 0.0f;
        for (std::size_t k = 0; k < count; ++k) sum += weights[v][k].weight;
        for (std::size_t k = 0; k < count; ++k) {
            vertex_joints[v][k] = static_cast<std::uint16_t>(weights[v][k].bone);
            vertex_weights[v][k] = weights[v][k].weight / sum;
        }
    }
    std::vector<std::uint32_t> corners;
    for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
    std::vector<DVec3> to_joints;
    for (const Joint& joint : joints) to_joints.push_back(-joint.position);

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
    for (Json& node : node_tree(joints, kFirstJoint)) nodes.push_back(std::move(node));
    Json numbers = Json::array();
    for (std::size_t j = 0; j < joints.size(); ++j) numbers.push_back(kFirstJoint + j);
    return builder.finish({{"scenes", {{{"nodes", {0, 1}}}}},
                           {"nodes", nodes},
                           {"meshes", {{{"primitives", {primitive}}, {"name", "model"}}}},
                           {"skins",
                            {{{"name", "armature"},
                              {"skeleton", 1},
                              {"joints", numbers},
                              {"inverseBindMatrices", builder.add_moves(to_joints)}}}}},
                          origin, GltfContainer::Binary);
}

}  // namespace zskel
