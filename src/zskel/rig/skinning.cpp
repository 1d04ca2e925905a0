#include "zskel/rig/skinning.h"

#include <algorithm>
#include <limits>

#include "zskel/core/parallel.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/self_intersections.h"
#include "zskel/mesh/signed_volume.h"
#include "zskel/mesh/surface.h"

namespace zskel {
namespace {

// Along its bones, which reach on beyond their ends, so that one stretch over several is even.
DVec3 stretched(const DVec3& point, const Armature& armature,
                const std::vector<Influence>& influences, const std::vector<BoneMotion>& motions) {
    DVec3 out = point;
    for (const Influence& i : influences) {
        const Bone& bone = armature.bones[i.bone];
        const BoneMotion& motion = motions[i.bone];
        const double longer = share_along(bone, point) * (motion.stretch - 1.0);
        out += (motion.shift + (bone.tail - bone.head) * longer) * static_cast<double>(i.weight);
    }
    return out;
}

DVec3 by_mean(const DVec3& point, const std::vector<Influence>& influences,
              const std::vector<BoneMotion>& motions) {
    DVec3 out(0.0);
    for (const Influence& i : influences) {
        const BoneMotion& motion = motions[i.bone];
        out += (motion.turn * point + motion.move) * static_cast<double>(i.weight);
    }
    return out;
}

// The mean of unit quaternions, each with the sign that is nearer to the first's.
struct BlendedTurn {
    glm::dquat turn{0, 0, 0, 0};
    glm::dquat dual{0, 0, 0, 0};  // half the move, times the turn
};
BlendedTurn blended(const std::vector<Influence>& influences,
                    const std::vector<BoneMotion>& motions) {
    BlendedTurn sum;
    const glm::dquat& first = motions[influences.front().bone].turn;
    for (const Influence& i : influences) {
        const BoneMotion& motion = motions[i.bone];
        const double weight =
            static_cast<double>(i.weight) * (glm::dot(first, motion.turn) < 0.0 ? -1.0 : 1.0);
        sum.turn = sum.turn + motion.turn * weight;
        sum.dual = sum.dual + glm::dquat(0.0, motion.move) * motion.turn * (0.5 * weight);
    }
    const double size = glm::length(sum.turn);
    return {sum.turn / size, sum.dual / size};
}

DVec3 by_dual_quaternion(const DVec3& point, const std::vector<Influence>& influences,
                         const std::vector<BoneMotion>& motions) {
    const BlendedTurn sum = blended(influences, motions);
    const glm::dquat move = sum.dual * glm::conjugate(sum.turn) * 2.0;
    return sum.turn * point + DVec3(move.x, move.y, move.z);
}

// The triangles between welded vertices; those of a closed surface are all turned outward.
struct Welded {
    std::vector<Triangle> triangles;
    bool is_closed = true;
};
Welded weld(const Mesh& mesh) {
    const PreparedSurface prepared = prepare_surface(mesh);
    const auto& closed = prepared.component_closed;
    return {input_triangles(prepared),
            std::find(closed.begin(), closed.end(), false) == closed.end()};
}

}  // namespace

std::vector<DVec3> deform(const Mesh& mesh, const Armature& armature,
                          const std::vector<std::vector<Influence>>& weights,
                          const std::vector<BoneMotion>& motions, Skinning skinning) {
    std::vector<DVec3> out(mesh.positions.size());
    parallel_for(out.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const DVec3 point = stretched(mesh.positions[v], armature, weights[v], motions);
            out[v] = skinning == Skinning::Linear ? by_mean(point, weights[v], motions)
                                                  : by_dual_quaternion(point, weights[v], motions);
        }
    });
    return out;
}

SkeletonGraph deform_skeleton(const SkeletonGraph& graph, const Armature& armature,
                              const std::vector<BoneMotion>& motions) {
    SkeletonGraph out = graph;
    for (std::size_t n = 0; n < out.nodes.size(); ++n) {
        const std::vector<Influence> follows{{armature.node_bones[n].front(), 1.0f}};
        DVec3& place = out.nodes[n].position;
        place = by_mean(stretched(place, armature, follows, motions), follows, motions);
    }
    return out;
}

DeformMeasures measure_deformation(const Mesh& mesh, const std::vector<DVec3>& deformed,
                                   const std::vector<std::vector<Influence>>& weights,
                                   const std::vector<BoneMotion>& motions) {
    DeformMeasures out;
    const Welded welded = weld(mesh);
    const double before = signed_volume(mesh.positions, welded.triangles);
    if (welded.is_closed && before > 0.0)
        out.volume_change = signed_volume(deformed, welded.triangles) / before - 1.0;
    out.crossing_at_rest = crossing_triangles(mesh.positions, welded.triangles)->size();
    out.crossing_faces = crossing_triangles(deformed, welded.triangles)->size();

    std::vector<double> stretches;
    for (const Triangle& t : mesh.triangles) {
        const DVec3 rest = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                      mesh.positions[t.z] - mesh.positions[t.x]);
        const DVec3 now = glm::cross(deformed[t.y] - deformed[t.x], deformed[t.z] - deformed[t.x]);
        DVec3 expected(0.0);
        for (int k = 0; k < 3; ++k) {
            expected += blended(weights[t[k]], motions).turn * rest;
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
            if (length > 0.0) stretches.push_back(glm::distance(deformed[a], deformed[b]) / length);
        }
        out.flipped_faces += glm::dot(now, expected) < 0.0 ? 1 : 0;
    }
    if (!stretches.empty()) {
        const auto at = [&](double share) {
            const auto place =
                stretches.begin() +
                static_cast<std::ptrdiff_t>(share * static_cast<double>(stretches.size() - 1));
            std::nth_element(stretches.begin(), place, stretches.end());
            return *place;
        };
        out.edge_stretch_median = at(0.5);
        for (double& s : stretches)
            s = s > 0.0 ? std::max(s, 1.0 / s) : std::numeric_limits<double>::infinity();
        out.edge_stretch_p99 = at(0.99);
        out.edge_stretch_worst = at(1.0);
    }

    for (std::size_t v = 0; v < deformed.size(); ++v)
        out.farthest = std::max(out.farthest, glm::distance(deformed[v], mesh.positions[v]));
    out.farthest /= std::max(box_of(mesh.positions).diagonal(), std::numeric_limits<double>::min());
    return out;
}

}  // namespace zskel
