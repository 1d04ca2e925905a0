// The assignment is by augmenting paths: Kuhn, The Hungarian Method for the Assignment Problem
// (1955), without weights.
#include "scoring/limbs.h"

#include <algorithm>

namespace zskel::scoring {
namespace {

std::vector<Piece> last_part(const SkeletonGraph& graph, const std::vector<std::uint32_t>& nodes,
                             double share) {
    std::vector<Piece> pieces = pieces_along(graph, nodes);
    double left = 0.0;
    for (const Piece& piece : pieces) left += glm::distance(piece.a, piece.b);
    left *= share;
    std::vector<Piece> out;
    for (auto at = pieces.rbegin(); at != pieces.rend() && (out.empty() || left > 0.0); ++at) {
        const double length = glm::distance(at->a, at->b);
        const double kept = length > left ? left / length : 1.0;
        out.push_back({glm::mix(at->b, at->a, kept), at->b,
                       glm::mix(at->radius_b, at->radius_a, kept), at->radius_b});
        left -= length;
    }
    return out;
}

Piece beyond(const Piece& last, double radii) {
    const DVec3 along = last.b - last.a;
    const double length = glm::length(along);
    const DVec3 step = length > 0.0 ? along * (radii * last.radius_b / length) : DVec3(0.0);
    return {last.b, last.b + step, last.radius_b, last.radius_b};
}

class Matching {
  public:
    Matching(const std::vector<std::vector<std::uint32_t>>& choices, std::size_t right_count)
        : choices_(choices), left_of_(right_count, kNone) {
        for (std::uint32_t left = 0; left < choices.size(); ++left) {
            tried_.assign(right_count, false);
            place(left);
        }
    }
    const std::vector<std::uint32_t>& left_of() const { return left_of_; }

  private:
    // Gives `left` one of its choices, moving others to theirs where that has to be.
    bool place(std::uint32_t left) {
        for (const std::uint32_t right : choices_[left]) {
            if (tried_[right]) continue;
            tried_[right] = true;
            if (left_of_[right] != kNone && !place(left_of_[right])) continue;
            left_of_[right] = left;
            return true;
        }
        return false;
    }

    const std::vector<std::vector<std::uint32_t>>& choices_;
    std::vector<std::uint32_t> left_of_;
    std::vector<bool> tried_;
};

}  // namespace

std::vector<TipRegion> tip_regions(const Truth& truth, double share, double radii_beyond) {
    const std::vector<std::uint32_t> degrees = node_degrees(truth.graph);
    std::vector<TipRegion> out;
    const auto add = [&](const std::string& name, const std::vector<std::uint32_t>& nodes) {
        std::vector<Piece> pieces = last_part(truth.graph, nodes, share);
        pieces.push_back(beyond(pieces.front(), radii_beyond));
        out.push_back({name, std::move(pieces)});
    };
    for (const Limb& limb : truth.limbs) {
        const std::vector<std::uint32_t> reversed(limb.nodes.rbegin(), limb.nodes.rend());
        const bool starts_free = degrees[limb.nodes.front()] == 1;
        const bool ends_free = degrees[limb.nodes.back()] == 1;
        const bool both = starts_free && ends_free;
        if (starts_free) add(limb.name + (both ? " (first end)" : ""), reversed);
        if (ends_free) add(limb.name + (both ? " (last end)" : ""), limb.nodes);
    }
    return out;
}

std::vector<Limb> inner_limbs(const Truth& truth) {
    const std::vector<std::uint32_t> degrees = node_degrees(truth.graph);
    std::vector<Limb> out;
    for (const Limb& limb : truth.limbs) {
        if (degrees[limb.nodes.front()] != 1 && degrees[limb.nodes.back()] != 1)
            out.push_back(limb);
    }
    return out;
}

std::vector<std::uint32_t> assign(const std::vector<std::vector<std::uint32_t>>& choices,
                                  std::size_t right_count) {
    return Matching(choices, right_count).left_of();
}

}  // namespace zskel::scoring
