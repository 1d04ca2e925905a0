#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/skeleton/graph.h"

namespace zskel::scoring {

/// A point on a skeleton.
struct CurveSample {
    DVec3 position{0.0};
    std::uint32_t edge = kNone;  ///< that it lies on; kNone at a node without edges
    double weight = 0.0;         ///< the length that it stands for
};

/// Points in the middles of equal parts of every edge, at most `spacing` long. Of a skeleton
/// without edges: its nodes, with weight 1.
std::vector<CurveSample> sample_curve(const SkeletonGraph& graph, double spacing);

/// Points at equal steps along a branch, at most `step` long, both ends among them; one point where
/// the branch has no length. Weights are 0.
std::vector<CurveSample> resample_branch(const SkeletonGraph& graph, const Branch& branch,
                                         double step);

/// A straight piece of a skeleton with the radii at its ends; a node alone is a piece of length 0.
struct Piece {
    DVec3 a{0.0};
    DVec3 b{0.0};
    double radius_a = 0.0;
    double radius_b = 0.0;
};

/// Every edge, in order, then the nodes without edges.
std::vector<Piece> pieces_of(const SkeletonGraph& graph);
/// Along a list of nodes; of a single one: that node.
std::vector<Piece> pieces_along(const SkeletonGraph& graph, std::span<const std::uint32_t> nodes);

/// The nearest point of some pieces.
struct Foot {
    double distance = kInfinity;
    double radius = 0.0;  ///< of the skeleton there, linear between nodes
};
Foot nearest_foot(std::span<const Piece> pieces, const DVec3& point);

/// The least distance in local radii: below 1 within the balls that the pieces carry.
double radii_away(std::span<const Piece> pieces, const DVec3& point);

/// Distance of each point, in parallel.
std::vector<double> distances_to(std::span<const Piece> pieces, std::span<const DVec3> points);

/// Mean distance of the samples' points, by weight, and the largest.
struct CurveDistance {
    double mean = kInfinity;
    double largest = kInfinity;
};
CurveDistance distance_between(std::span<const CurveSample> from, std::span<const Piece> to);

}  // namespace zskel::scoring
