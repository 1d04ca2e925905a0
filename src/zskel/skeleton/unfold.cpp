// Trajectories that come down one limb and go up another may join limbs past a third's tip, where a
// skeleton has an end.
#include "zskel/skeleton/unfold.h"

#include <algorithm>
#include <optional>

#include "zskel/skeleton/path.h"

namespace zskel {
namespace {

constexpr float kStep = 0.25f;      // along a fold, in radii
constexpr float kMostApart = 0.5f;  // a radius from a fold's tip the ways are nearer, in radii

using Strand = std::vector<std::uint32_t>;

class Unfolder {
  public:
    Unfolder(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options)
        : graph_(graph), query_(query), most_aside_(static_cast<float>(options.zip_radii)) {}

    // The sharpest first: the nodes beside a tip are folds too until that is one no more.
    std::size_t run() {
        std::vector<std::pair<float, std::uint32_t>> folds;
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (const std::optional<float> apart = apart_after_radius(n))
                folds.emplace_back(*apart, n);
        }
        std::sort(folds.begin(), folds.end());
        std::size_t unfolded = 0;
        for (const auto& [apart, n] : folds) {
            while (apart_after_radius(n) && unfold(n)) ++unfolded;
        }
        return unfolded;
    }

  private:
    // The part of a strand up to a length, and where it goes on.
    struct Stretch {
        std::vector<Vec3> points;
        std::size_t next = 0;
    };

    // No farther than to the next end or junction.
    Strand strand_of_length(std::uint32_t node, std::uint32_t next, float length) const {
        Strand out{node, next};
        length -= glm::distance(graph_.at(node), graph_.at(next));
        while (length > 0.0f && graph_.nodes[out.back()].links.size() == 2 && out.back() != node) {
            const auto& links = graph_.nodes[out.back()].links;
            out.push_back(links[0] == out[out.size() - 2] ? links[1] : links[0]);
            length -= glm::distance(graph_.at(out[out.size() - 2]), graph_.at(out.back()));
        }
        return out;
    }

    Stretch stretch(const Strand& strand, float length) const {
        Stretch out{{graph_.at(strand[0])}, 1};
        for (; out.next < strand.size(); ++out.next) {
            const Vec3& from = out.points.back();
            const Vec3& to = graph_.at(strand[out.next]);
            const float piece = glm::distance(from, to);
            if (piece >= length) {
                out.points.push_back(glm::mix(from, to, length / piece));
                return out;
            }
            length -= piece;
            out.points.push_back(to);
        }
        return out;
    }

    // Of the ways from a node, in its radii, after one of these; nothing where they do not all go
    // the same way.
    std::optional<float> apart_after_radius(std::uint32_t node) const {
        const CurveGraph::Node& at = graph_.nodes[node];
        if (at.is_removed || at.links.size() < 2 || at.radius <= 0.0f) return std::nullopt;
        std::vector<Vec3> places;
        float apart = 0.0f;
        for (const std::uint32_t next : at.links) {
            places.push_back(
                stretch(strand_of_length(node, next, at.radius), at.radius).points.back());
            for (const Vec3& other : places)
                apart = std::max(apart, glm::distance(places.back(), other) / at.radius);
            if (apart > kMostApart) return std::nullopt;
        }
        return apart;
    }

    // Makes one of the longest way from a tip and the shortest, as far as they go side by side.
    bool unfold(std::uint32_t tip) {
        std::vector<Strand> strands;
        for (const std::uint32_t next : graph_.nodes[tip].links)
            strands.push_back(graph_.branch_from(tip, next));
        const auto [shortest, longest] = std::ranges::minmax_element(
            strands, {}, [&](const Strand& strand) { return graph_.length_along(strand); });
        const Strand& stays = *longest;
        const Strand& goes = *shortest;
        if (stays.back() == tip || goes.back() == tip || &stays == &goes) return false;
        const float length = graph_.length_along(goes);
        const float step = kStep * graph_.nodes[tip].radius;
        float beside = 0.0f;
        while (beside + step < length && is_beside(stays, goes, beside + step)) beside += step;
        const bool has_end = graph_.nodes[goes.back()].links.size() == 1;
        if (has_end && beside + step >= length && is_beside(stays, goes, length)) {
            give_up(goes, goes.size(), tip);
            return true;
        }
        // Back to where the way that stays sees the one that goes on.
        for (; beside > 0.0f; beside -= step) {
            const Stretch gone = stretch(goes, beside);
            const std::uint32_t next = goes[gone.next];
            const std::optional<Joint> joint = joint_beside(stays, gone.points.back(), next);
            if (!joint) continue;
            // A limb is longer than its body is thick.
            if (glm::distance(graph_.at(tip), joint->place) < query_.nearest(joint->place).distance)
                return false;
            const std::uint32_t node = split(stays, *joint);
            give_up(goes, gone.next, node);
            graph_.unlink(goes[gone.next - 1], next);
            graph_.link(node, next);
            return true;
        }
        return false;
    }

    bool is_beside(const Strand& stays, const Strand& goes, float length) const {
        const Vec3 p = stretch(goes, length).points.back();
        const float radius = query_.nearest(p).distance;
        return distance_to(stretch(stays, length + radius).points, p) <= most_aside_ * radius;
    }

    struct Joint {
        std::size_t segment = 0;  // of the strand, by its first node
        Vec3 place{0.0f};
    };

    std::optional<Joint> joint_beside(const Strand& stays, const Vec3& p,
                                      std::uint32_t next) const {
        Joint best;
        float least = kInfinity;
        for (std::size_t i = 0; i + 1 < stays.size(); ++i) {
            if (stays[i] == next || stays[i + 1] == next) return std::nullopt;
            const Vec3& a = graph_.at(stays[i]);
            const Vec3 ab = graph_.at(stays[i + 1]) - a;
            const float share = glm::dot(p - a, ab) / std::max(glm::dot(ab, ab), 1e-30f);
            const Vec3 foot = a + std::clamp(share, 0.0f, 1.0f) * ab;
            const float distance = glm::distance(foot, p);
            if (distance >= least) continue;
            least = distance;
            best = {i, foot};
        }
        return query_.sees(best.place, graph_.at(next)) ? std::optional(best) : std::nullopt;
    }

    std::uint32_t split(const Strand& strand, const Joint& joint) {
        const std::uint32_t node = graph_.add(joint.place, query_.nearest(joint.place).distance);
        graph_.unlink(strand[joint.segment], strand[joint.segment + 1]);
        graph_.link(strand[joint.segment], node);
        graph_.link(node, strand[joint.segment + 1]);
        return node;
    }

    // The nodes of a strand after its first, up to the one before `end`.
    void give_up(const Strand& strand, std::size_t end, std::uint32_t to) {
        for (std::size_t k = 1; k < end; ++k) {
            graph_.unlink(strand[k - 1], strand[k]);
            graph_.give_up(strand[k], to);
        }
    }

    CurveGraph& graph_;
    const SurfaceQuery& query_;
    const float most_aside_;
};

}  // namespace

std::size_t unfold_branches(CurveGraph& graph, const SurfaceQuery& query,
                            const RefineOptions& options) {
    return Unfolder(graph, query, options).run();
}

}  // namespace zskel
