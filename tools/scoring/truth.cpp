#include "scoring/truth.h"

#include <algorithm>

#include "scoring/curve.h"
#include "scoring/limbs.h"
#include "scoring/numbers.h"

namespace zskel::scoring {
namespace {

constexpr double kSpacing = 0.002;

std::vector<std::uint32_t> ends_of(const SkeletonGraph& graph) {
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    std::vector<std::uint32_t> ends;
    for (std::uint32_t n = 0; n < degrees.size(); ++n) {
        if (degrees[n] == 1) ends.push_back(n);
    }
    return ends;
}

// Which of the ends are near enough to a tip region, the nearest first.
std::vector<std::uint32_t> ends_at(const TipRegion& tip, const std::vector<DVec3>& ends) {
    std::vector<std::pair<double, std::uint32_t>> near;
    for (std::uint32_t e = 0; e < ends.size(); ++e) {
        const double radii = radii_away(tip.pieces, ends[e]);
        if (radii <= kFoundRadii) near.emplace_back(radii, e);
    }
    std::sort(near.begin(), near.end());
    std::vector<std::uint32_t> out;
    for (const auto& [radii, end] : near) out.push_back(end);
    return out;
}

std::string nearest_limb(const Truth& truth, const DVec3& point) {
    std::string name;
    double best = kInfinity;
    for (const Limb& limb : truth.limbs) {
        const double radii = radii_away(pieces_along(truth.graph, limb.nodes), point);
        if (radii < best) name = limb.name;
        best = std::min(best, radii);
    }
    return name;
}

bool is_followed(const Truth& truth, const Limb& limb, const std::vector<Piece>& ours) {
    double near = 0.0;
    double all = 0.0;
    for (const Piece& piece : pieces_along(truth.graph, limb.nodes)) {
        const double radius = 0.5 * (piece.radius_a + piece.radius_b);
        // A limb of one node has no length; it counts by itself.
        const double length = limb.nodes.size() == 1 ? 1.0 : glm::distance(piece.a, piece.b);
        all += length;
        if (nearest_foot(ours, 0.5 * (piece.a + piece.b)).distance <= kFollowedRadii * radius)
            near += length;
    }
    return near >= kFollowedShare * all;
}

// Fills missed and invented.
void match_limbs(const Truth& truth, const SkeletonGraph& graph, TruthScore& score) {
    const std::vector<TipRegion> tips = tip_regions(truth, kTipShare, kTipRadii);
    std::vector<DVec3> ends;
    for (const std::uint32_t n : ends_of(graph)) ends.push_back(graph.nodes[n].position);
    std::vector<std::vector<std::uint32_t>> choices;
    for (const TipRegion& tip : tips) choices.push_back(ends_at(tip, ends));
    const std::vector<std::uint32_t> tip_of_end = assign(choices, ends.size());

    for (std::uint32_t t = 0; t < tips.size(); ++t) {
        if (std::find(tip_of_end.begin(), tip_of_end.end(), t) == tip_of_end.end())
            score.missed.push_back(tips[t].name);
    }
    const std::vector<Piece> true_pieces = pieces_of(truth.graph);
    for (std::size_t e = 0; e < ends.size(); ++e) {
        if (tip_of_end[e] == kNone && radii_away(true_pieces, ends[e]) > kInventedRadii)
            score.invented.push_back(nearest_limb(truth, ends[e]));
    }
    const std::vector<Limb> inner = inner_limbs(truth);
    for (const Limb& limb : inner) {
        if (!is_followed(truth, limb, pieces_of(graph))) score.missed.push_back(limb.name);
    }
    score.limbs = tips.size() + inner.size();
}

bool is_in_junction(const Truth& truth, const std::vector<std::uint32_t>& degrees,
                    const DVec3& point) {
    for (std::size_t n = 0; n < degrees.size(); ++n) {
        const SkeletonGraph::Node& node = truth.graph.nodes[n];
        if (degrees[n] >= 3 && glm::distance(node.position, point) <= node.radius) return true;
    }
    return false;
}

std::optional<double> radius_error(const Truth& truth, const SkeletonGraph& graph) {
    const std::vector<std::uint32_t> degrees = node_degrees(truth.graph);
    const std::vector<Piece> ours = pieces_of(graph);
    std::vector<double> errors;
    for (const Limb& limb : truth.limbs) {
        if (!limb.is_tube) continue;
        for (const std::uint32_t n : limb.nodes) {
            const SkeletonGraph::Node& node = truth.graph.nodes[n];
            const Foot foot = nearest_foot(ours, node.position);
            if (foot.distance > kMatchedRadii * node.radius) continue;
            if (is_in_junction(truth, degrees, node.position)) continue;
            errors.push_back(std::abs(foot.radius / node.radius - 1.0));
        }
    }
    return median(errors);
}

}  // namespace

TruthScore score_against(const Truth& truth, const SkeletonGraph& graph) {
    TruthScore score;
    score.from_truth = distance_between(sample_curve(truth.graph, kSpacing), pieces_of(graph)).mean;
    score.to_truth = distance_between(sample_curve(graph, kSpacing), pieces_of(truth.graph)).mean;
    match_limbs(truth, graph, score);
    score.radius_error = radius_error(truth, graph);
    return score;
}

}  // namespace zskel::scoring
