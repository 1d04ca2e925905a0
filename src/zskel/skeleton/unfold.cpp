// Trajectories that come down one limb and go up another may join limbs past a third's tip, where a
// skeleton has an end.
#include "zskel/skeleton/unfold.h"

#include <algorithm>
#include <optional>

#include "zskel/skeleton/path.h"

namespace zskel {
namespace {

constexpr float kStep = 0.25f;      // along a fold, in radii,
constexpr float kMostSteps = 200;   // but no more than so many
constexpr float kMostApart = 0.5f;  // a radius from a fold's tip the ways are nearer, in radii

using Strand = std::vector<std::uint32_t>;

class Unfolder {
  public:
    Unfolder(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options)
        : graph_(graph), query_(query), most_aside_(static_cast<float>(options.zip_radii)) {}

    // The sharpest first: the nodes beside a tip are folds too until that is one no more.
    std::size_t run() {
        for (CurveGraph::Node& node : graph_.nodes) {
            if (!node.is_removed) node.radius = query_.nearest(node.position).distance;
        }
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

    // To its last node where it is no longer.
    Stretch stretch(const Strand& strand, float length) const {
        Stretch out{{graph_.at(strand[0])}, 1};
        while (true) {
            const Vec3& from = out.points.back();
            const Vec3& to = graph_.at(strand[out.next]);
            const float piece = glm::distance(from, to);
            if (piece >= length || out.next + 1 == strand.size()) {
                const float share = piece > 0.0f ? std::clamp(length / piece, 0.0f, 1.0f) : 0.0f;
                out.points.push_back(glm::mix(from, to, share));
                return out;
            }
            length -= piece;
            out.points.push_back(to);
            ++out.next;
        }
    }

    // Of the ways from a node, in its radii, after one of these; nothing where they do not all go
    // the same way, and so far.
    std::optional<float> apart_after_radius(std::uint32_t node) const {
        const CurveGraph::Node& at = graph_.nodes[node];
        if (at.is_removed || at.links.size() < 2 || at.radius <= 0.0f) return std::nullopt;
        std::vector<Vec3> places;
        float apart = 0.0f;
        for (const std::uint32_t next : at.links) {
            const Strand way = strand_of_length(node, next, at.radius);
            if (graph_.length_along(way) < at.radius) return std::nullopt;
            places.push_back(stretch(way, at.radius).points.back());
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
        const float step = std::max(kStep * graph_.nodes[tip].radius, length / kMostSteps);
        float beside = 0.0f;
        while (beside + step < length && is_beside(stays, goes, beside + step)) beside += step;
        const bool has_end = graph_.nodes[goes.back()].links.size() == 1;
        if (has_end && beside + step >= length && is_beside(stays, goes, length)) {
            give_up(goes, goes.size(), stays);
            return true;
        }
        // Back to where the way that stays sees the one that goes on.
        for (; beside > 0.0f; beside -= step) {
            const Stretch gone = stretch(goes, beside);
            const std::uint32_t next = goes[gone.next];
            const std::optional<Joint> joint = joint_beside(stays, beside, gone.points.back());
            if (!joint || std::ranges::find(stays, next) != stays.end() ||
                !query_.sees(joint->place, graph_.at(next)))
                continue;
            // A limb is longer than its body is thick.
            if (glm::distance(graph_.at(tip), joint->place) < query_.nearest(joint->place).distance)
                return false;
            Strand limb(stays.begin(),
                        stays.begin() + static_cast<std::ptrdiff_t>(joint->segment) + 1);
            limb.push_back(split(stays, *joint));
            give_up(goes, gone.next, limb);
            graph_.unlink(goes[gone.next - 1], next);
            graph_.link(limb.back(), next);
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

    // Within the strand's segments up to a little past that length.
    std::optional<Joint> joint_beside(const Strand& stays, float length, const Vec3& p) const {
        const std::size_t end = stretch(stays, length + query_.nearest(p).distance).next;
        std::optional<Joint> best;
        float least = kInfinity;
        for (std::size_t i = 0; i < end; ++i) {
            const Vec3 foot = nearest_on_segment(graph_.at(stays[i]), graph_.at(stays[i + 1]), p);
            const float distance = glm::distance(foot, p);
            if (distance >= least) continue;
            least = distance;
            best = Joint{i, foot};
        }
        const bool is_end = best && best->place == graph_.at(stays.back());
        return is_end ? std::nullopt : best;
    }

    // The node there: a new one, but where one stands already.
    std::uint32_t split(const Strand& strand, const Joint& joint) {
        for (const std::size_t end : {joint.segment, joint.segment + 1}) {
            if (graph_.at(strand[end]) == joint.place) return strand[end];
        }
        const std::uint32_t node = graph_.add(joint.place, query_.nearest(joint.place).distance);
        graph_.unlink(strand[joint.segment], strand[joint.segment + 1]);
        graph_.link(strand[joint.segment], node);
        graph_.link(node, strand[joint.segment + 1]);
        return node;
    }

    // The nodes of a strand after its first, up to the one before `end`: their surface goes to what
    // stays beside them.
    void give_up(const Strand& strand, std::size_t end, const Strand& beside) {
        for (std::size_t k = 1; k < end; ++k) {
            const Vec3& place = graph_.at(strand[k]);
            const auto nearest = std::ranges::min_element(
                beside, {}, [&](std::uint32_t n) { return glm::distance(graph_.at(n), place); });
            graph_.unlink(strand[k - 1], strand[k]);
            graph_.give_up(strand[k], *nearest);
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
