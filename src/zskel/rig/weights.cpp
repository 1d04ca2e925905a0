#include "zskel/rig/weights.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/surface.h"

namespace zskel {
namespace {

constexpr double kMostCotangent = 100.0;  // needles do not couple more strongly than that
constexpr double kLeastRadius = 1e-6;     // in the unit cube
constexpr double kLeastArea = 1e-9;       // of a vertex, in shares of the mean one

std::uint32_t nearest_bone(const Armature& armature, const std::vector<std::uint32_t>& bones,
                           const DVec3& point) {
    return *std::min_element(bones.begin(), bones.end(), [&](std::uint32_t a, std::uint32_t b) {
        return distance_to(armature.bones[a], point) < distance_to(armature.bones[b], point);
    });
}

class Diffusion {
  public:
    // @param radii  of every vertex of the surface, in its own space.
    Diffusion(const Surface& surface, const std::vector<double>& radii, double smoothing)
        : hold_(static_cast<Eigen::Index>(radii.size())) {
        std::vector<double> areas(radii.size(), 0.0);
        std::vector<Eigen::Triplet<double>> entries;
        std::vector<double> diagonal(radii.size(), 0.0);
        double area_sum = 0.0;
        for (const Triangle& t : surface.triangles) {
            std::array<DVec3, 3> p;
            for (int k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = surface.positions[t[k]];
            const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
            area_sum += area;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto corner = static_cast<int>(k);
                areas[t[corner]] += area / 3.0;
                const std::uint32_t a = t[(corner + 1) % 3];
                const std::uint32_t b = t[(corner + 2) % 3];
                const double cosine = glm::dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                const double cotangent =
                    area > 0.0 ? std::clamp(0.25 * cosine / area, 0.0, kMostCotangent) : 0.0;
                if (cotangent == 0.0) continue;
                entries.emplace_back(static_cast<int>(std::max(a, b)),
                                     static_cast<int>(std::min(a, b)), -cotangent);
                diagonal[a] += cotangent;
                diagonal[b] += cotangent;
            }
        }
        const double least = kLeastArea * area_sum / static_cast<double>(radii.size());
        for (std::size_t v = 0; v < radii.size(); ++v) {
            const double area = std::max(areas[v], least);
            const double reach = std::max(smoothing * radii[v], std::sqrt(area));
            const double hold = area / (reach * reach);
            hold_[static_cast<Eigen::Index>(v)] = hold;
            entries.emplace_back(static_cast<int>(v), static_cast<int>(v), diagonal[v] + hold);
        }
        const auto size = static_cast<Eigen::Index>(radii.size());
        Eigen::SparseMatrix<double> matrix(size, size);
        matrix.setFromTriplets(entries.begin(), entries.end());
        solver_.compute(matrix);
        if (solver_.info() != Eigen::Success)
            throw Error(ExitCode::Internal, "skin weights: the diffusion has no solution");
    }

    Eigen::VectorXd spread(const std::vector<std::uint32_t>& first, std::uint32_t bone) const {
        Eigen::VectorXd right = Eigen::VectorXd::Zero(hold_.size());
        for (std::size_t v = 0; v < first.size(); ++v) {
            const auto row = static_cast<Eigen::Index>(v);
            if (first[v] == bone) right[row] = hold_[row];
        }
        return solver_.solve(right);
    }

  private:
    Eigen::VectorXd hold_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

bool hangs_on(const Armature& armature, std::uint32_t bone, std::uint32_t on) {
    while (bone != kNone && bone != on) bone = armature.bones[bone].parent;
    return bone == on;
}

// What hangs on the same bone side by side pulls at a vertex by turns: the strongest of such
// subtrees keeps what it is stronger by than the next, the others nothing; the bone has the rest.
class Rivals {
  public:
    Rivals(const Armature& armature, std::vector<Influence>& influences)
        : armature_(armature), influences_(influences) {}

    void part() {
        for (Tree tree = sums(); std::optional<std::uint32_t> bone = contested(tree); tree = sums())
            part_children_of(*bone, tree);
    }

  private:
    using Tree = std::map<std::uint32_t, float>;  // parents before children, as bones are numbered

    // What each bone and all that hangs on it pull.
    Tree sums() const {
        Tree tree;
        for (const Influence& i : influences_) {
            for (std::uint32_t b = i.bone; b != kNone; b = armature_.bones[b].parent)
                tree[b] += i.weight;
        }
        return tree;
    }

    std::optional<std::uint32_t> contested(const Tree& tree) const {
        std::map<std::uint32_t, int> children;
        for (const auto& [bone, sum] : tree) {
            const std::uint32_t parent = armature_.bones[bone].parent;
            if (parent != kNone && sum > 0.0f && ++children[parent] > 1) return parent;
        }
        return std::nullopt;
    }

    void part_children_of(std::uint32_t parent, const Tree& tree) {
        std::uint32_t strongest = kNone;
        float most = 0.0f;
        float next = 0.0f;
        for (const auto& [bone, sum] : tree) {
            if (armature_.bones[bone].parent != parent) continue;
            if (sum > most) {
                next = std::exchange(most, sum);
                strongest = bone;
            } else {
                next = std::max(next, sum);
            }
        }
        const float share = (most - next) / most;
        float freed = 0.0f;
        for (Influence& i : influences_) {
            if (i.bone == parent || !hangs_on(armature_, i.bone, parent)) continue;
            const float kept = hangs_on(armature_, i.bone, strongest) ? share * i.weight : 0.0f;
            freed += i.weight - kept;
            i.weight = kept;
        }
        const auto own = std::find_if(influences_.begin(), influences_.end(),
                                      [&](const Influence& i) { return i.bone == parent; });
        if (own != influences_.end())
            own->weight += freed;
        else
            influences_.push_back({parent, freed});
        std::erase_if(influences_, [](const Influence& i) { return !(i.weight > 0.0f); });
    }

    const Armature& armature_;
    std::vector<Influence>& influences_;
};

void keep_strongest(std::vector<Influence>& influences, const WeightOptions& options) {
    std::sort(influences.begin(), influences.end(), [](const Influence& a, const Influence& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.bone < b.bone;
    });
    while (influences.size() > std::max<std::size_t>(options.max_influences, 1) ||
           (influences.size() > 1 &&
            static_cast<double>(influences.back().weight) < options.least_weight))
        influences.pop_back();
    double sum = 0.0;
    for (const Influence& i : influences) sum += static_cast<double>(i.weight);
    for (Influence& i : influences)
        i.weight = static_cast<float>(static_cast<double>(i.weight) / sum);
}

}  // namespace

std::vector<std::vector<Influence>> skin_weights(const Mesh& mesh, const SkeletonGraph& graph,
                                                 const Armature& armature,
                                                 const WeightOptions& options) {
    if (graph.vertex_node.size() != mesh.positions.size()) {
        throw InputError(fmt::format("{}: it has {} vertices, its skeleton knows of {}", mesh.name,
                                     mesh.positions.size(), graph.vertex_node.size()));
    }
    if (armature.bones.empty()) throw InputError(mesh.name + ": its skeleton has no bones");
    const PreparedSurface prepared = prepare_surface(mesh);
    const Surface& surface = prepared.surface;
    std::vector<std::uint32_t> all(armature.bones.size());
    for (std::uint32_t b = 0; b < all.size(); ++b) all[b] = b;

    std::vector<std::uint32_t> first(surface.positions.size(), kNone);
    std::vector<double> radii(first.size(), 0.0);
    double thickest = 0.0;
    for (std::size_t place = 0; place < first.size(); ++place) {
        const std::uint32_t v = prepared.input_vertex[place];
        const std::uint32_t node = graph.vertex_node[v];
        const bool has_bones = node != kNone && !armature.node_bones[node].empty();
        first[place] =
            nearest_bone(armature, has_bones ? armature.node_bones[node] : all, mesh.positions[v]);
        radii[place] =
            surface.world_from_model.scale *
            (node != kNone ? graph.nodes[node].radius : armature.bones[first[place]].radius);
        thickest = std::max(thickest, radii[place]);
    }
    // A node on the surface itself, as open meshes have, must not hold without end.
    const double least = std::max(1e-3 * thickest, kLeastRadius);
    for (double& radius : radii) radius = std::max(radius, least);

    const Diffusion diffusion(surface, radii, options.smoothing_radii);
    std::vector<std::vector<Influence>> places(first.size());
    std::mutex mutex;
    parallel_for(all.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const auto bone = static_cast<std::uint32_t>(b);
            const Eigen::VectorXd weights = diffusion.spread(first, bone);
            const std::lock_guard lock(mutex);
            for (std::size_t v = 0; v < places.size(); ++v) {
                const double weight = weights[static_cast<Eigen::Index>(v)];
                if (weight <= 1e-4 * options.least_weight) continue;
                if (hangs_on(armature, first[v], bone) || hangs_on(armature, bone, first[v]))
                    places[v].push_back({bone, static_cast<float>(weight)});
            }
        }
    });
    for (std::size_t v = 0; v < places.size(); ++v) {
        if (places[v].empty()) places[v] = {{first[v], 1.0f}};
        // Sums must not hang on which thread came first.
        std::ranges::sort(places[v], {}, &Influence::bone);
        Rivals(armature, places[v]).part();
        keep_strongest(places[v], options);
    }

    std::vector<std::vector<Influence>> out(mesh.positions.size());
    for (std::size_t v = 0; v < out.size(); ++v) {
        const std::uint32_t place = prepared.surface_vertex[v];
        if (place == kNone) {
            out[v] = {{nearest_bone(armature, all, mesh.positions[v]), 1.0f}};
        } else {
            out[v] = places[place];
        }
    }
    return out;
}

}  // namespace zskel
