#include "zskel/rig/joints.h"

#include <cmath>

#include "zskel/mesh/surface.h"

namespace zskel {
namespace {

constexpr double kMostRadii = 0.75;  // from a head to its joint
constexpr double kLeastArea = 0.1;   // of a cut across a limb, in squares of the bone's radius

// How the volume changes when what hangs on a bone moves by d and turns by the small angles n:
// dot(d, area) + dot(n, moment), the turn about the origin.
struct Gradient {
    DVec3 area{0.0};
    DVec3 moment{0.0};
};

// A third of the area vectors of the triangles round every vertex, those of caps among them: how
// the volume grows with it. Of vertices at one place one has it all.
std::vector<DVec3> volume_gradients(const Mesh& mesh) {
    const PreparedSurface prepared = prepare_surface(mesh, WorldSize::UnitCube, {.has_caps = true});
    std::vector<DVec3> out(mesh.positions.size(), DVec3(0.0));
    for (const Triangle& t : input_triangles(prepared)) {
        const DVec3& a = mesh.positions[t.x];
        const DVec3 third =
            glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a) * (0.5 / 3.0);
        for (int k = 0; k < 3; ++k) out[t[k]] += third;
    }
    return out;
}

// Of every bone with all that hangs on it, about its own head.
std::vector<Gradient> bone_gradients(const Mesh& mesh,
                                     const std::vector<std::vector<Influence>>& weights,
                                     const Armature& armature) {
    const std::vector<Bone>& bones = armature.bones;
    const std::vector<DVec3> gradients = volume_gradients(mesh);
    std::vector<Gradient> out(bones.size());
    for (std::size_t v = 0; v < weights.size(); ++v) {
        for (const Influence& influence : weights[v]) {
            const DVec3 share = gradients[v] * static_cast<double>(influence.weight);
            out[influence.bone].area += share;
            out[influence.bone].moment +=
                glm::cross(mesh.positions[v] - bones[influence.bone].head, share);
        }
    }
    for (std::size_t b = bones.size(); b-- > 0;) {
        const std::uint32_t parent = bones[b].parent;
        if (parent == kNone) continue;
        out[parent].area += out[b].area;
        out[parent].moment +=
            out[b].moment + glm::cross(bones[b].head - bones[parent].head, out[b].area);
    }
    return out;
}

}  // namespace

void centre_joints(const Mesh& mesh, const std::vector<std::vector<Influence>>& weights,
                   Armature& armature) {
    const std::vector<Gradient> gradients = bone_gradients(mesh, weights, armature);
    for (std::size_t b = 0; b < armature.bones.size(); ++b) {
        Bone& bone = armature.bones[b];
        const Gradient& gradient = gradients[b];
        const double square = glm::dot(gradient.area, gradient.area);
        const bool is_cut = std::sqrt(square) > kLeastArea * bone.radius * bone.radius;
        if (bone.parent == kNone || !is_cut) continue;
        const DVec3 move = glm::cross(gradient.area, gradient.moment) / square;
        if (glm::length(move) <= kMostRadii * bone.radius) bone.to_joint = move;
    }
}

}  // namespace zskel
