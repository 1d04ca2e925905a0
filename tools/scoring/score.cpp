#include "scoring/score.h"

#include <algorithm>

#include "scoring/cover.h"
#include "scoring/curve.h"
#include "scoring/numbers.h"
#include "scoring/shape.h"
#include "scoring/sides.h"
#include "zskel/core/error.h"

namespace zskel::scoring {
namespace {

constexpr double kSpacing = 0.002;
constexpr double kCompareSpacing = 0.001;
constexpr std::size_t kSurfacePoints = 4000;
constexpr double kCovered = 2.0;

SkeletonGraph prepared(const Subject& subject, const SkeletonFile& skeleton) {
    SkeletonGraph graph = subject.in_diagonals(skeleton.graph);
    if (skeleton.has_radii) return graph;
    for (SkeletonGraph::Node& node : graph.nodes) node.radius = subject.distance_at(node.position);
    return graph;
}

void measure_shape(const Subject& subject, const SkeletonGraph& graph, Score& score) {
    const std::vector<Branch> branches = find_branches(graph);
    const CurveSides sides(subject, graph);
    score.spurs = count_spurs(subject, graph, branches);
    score.turn_deg = mean_turn_deg(graph, branches);
    score.inside = sides.inside_share(sample_curve(graph, kSpacing));
    const std::vector<double> off = off_centre(subject, graph, branches, sides);
    score.off_centre_median = median(off);
    score.off_centre_p90 = quantile(off, 0.9);
    const std::vector<SurfacePoint> points = spread_points(subject.surface(), kSurfacePoints);
    const std::vector<double> cover = coverage(subject, graph, points);
    score.cover_p95 = quantile(cover, 0.95);
    if (!cover.empty()) {
        const auto covered = std::count_if(cover.begin(), cover.end(),
                                           [](double ratio) { return ratio <= kCovered; });
        score.cover_le2 = static_cast<double>(covered) / static_cast<double>(cover.size());
    }
    score.reconstruction = mean(reconstruction_gaps(subject, graph, sides, points));
}

}  // namespace

Score score_skeleton(const Subject& subject, const SkeletonFile& skeleton, const Truth* truth) {
    if (skeleton.graph.nodes.empty()) throw InputError("the skeleton has no nodes");
    const SkeletonGraph graph = prepared(subject, skeleton);
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    Score score;
    score.nodes = graph.nodes.size();
    score.ends = static_cast<std::size_t>(std::count(degrees.begin(), degrees.end(), 1u));
    score.topology = graph_topology(graph);
    score.expected_components = subject.expected_components();
    score.expected_cycles = subject.expected_cycles();
    score.evaluations = skeleton.evaluations;
    score.seconds = skeleton.seconds;
    measure_shape(subject, graph, score);
    if (truth != nullptr)
        score.truth = score_against({subject.in_diagonals(truth->graph), truth->limbs}, graph);
    return score;
}

SkeletonDistance compare_curves(const Subject& subject, const SkeletonGraph& a,
                                const SkeletonGraph& b) {
    const SkeletonGraph one = subject.in_diagonals(a);
    const SkeletonGraph other = subject.in_diagonals(b);
    const CurveDistance there =
        distance_between(sample_curve(one, kCompareSpacing), pieces_of(other));
    const CurveDistance back =
        distance_between(sample_curve(other, kCompareSpacing), pieces_of(one));
    return {0.5 * (there.mean + back.mean), std::max(there.largest, back.largest)};
}

}  // namespace zskel::scoring
