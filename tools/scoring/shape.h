#pragma once

#include <optional>
#include <vector>

#include "scoring/sides.h"
#include "scoring/subject.h"

namespace zskel::scoring {

/// Branches with one free end that are shorter than the distance from their inner end to the
/// surface: they do not leave the ball that the inner end stands for.
std::size_t count_spurs(const Subject& subject, const SkeletonGraph& graph,
                        const std::vector<Branch>& branches);

/// Mean angle, degrees, between one step and the next along branches, steps of 1 % of the diagonal;
/// none where no branch has two steps.
std::optional<double> mean_turn_deg(const SkeletonGraph& graph,
                                    const std::vector<Branch>& branches);

/// How far points along branches, 0.5 % apart, are from the middle of their cross-section: 48 rays
/// in the plane across the branch, each at most three times as long as the median one; the mean
/// over opposite rays a and b of |a - b| / (a + b). 0 in the centre of any section that is the same
/// turned by half a turn, 1 outside of the model. The ends of branches are left out.
std::vector<double> off_centre(const Subject& subject, const SkeletonGraph& graph,
                               const std::vector<Branch>& branches, const CurveSides& sides);

}  // namespace zskel::scoring
