#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scoring/skeleton_file.h"

namespace zskel::scoring {

// The page's legend (columns.cpp) says these in words.

/// What share of a limb, from its free end, is the region that one of our ends has to reach.
inline constexpr double kTipShare = 1.0 / 3.0;
/// How far, in radii of the end, that region goes on beyond it: the surface ends a radius or two
/// later, and a skeleton may run up to there.
inline constexpr double kTipRadii = 1.5;
/// How near to it, in the limb's radii there.
inline constexpr double kFoundRadii = 1.5;
/// What share of a limb without a free end has to be followed, and how near.
inline constexpr double kFollowedShare = 0.5;
inline constexpr double kFollowedRadii = 1.0;
/// How far, in the truth's local radii, an end that no limb accounts for has to be from all of the
/// truth to count as invented.
inline constexpr double kInventedRadii = 1.0 / 3.0;
/// How near to a true node, in its radii, radii are compared.
inline constexpr double kMatchedRadii = 0.5;

/// A skeleton against the one that its model was built from.
struct TruthScore {
    double from_truth = 0.0;             ///< mean distance of the truth to ours, diagonals
    double to_truth = 0.0;               ///< mean distance of ours to the truth, diagonals
    std::size_t limbs = 0;               ///< that can be missed: free ends, and limbs without any
    std::vector<std::string> missed;     ///< names, in the truth's order
    std::vector<std::string> invented;   ///< the limb each is nearest to, in the order of our nodes
    std::optional<double> radius_error;  ///< median of |ours / true - 1| on tubes
};

/// Scores `graph` against `truth`, both in diagonals.
///
/// *Limbs.* Each free end of a true limb is found when an end of ours is within kFoundRadii of the
/// limb's last kTipShare, prolonged by kTipRadii. An end of ours stands for one free end at most;
/// of all ways to assign them one that finds the most limbs is taken. A limb without a free end (a
/// body, a ring) is found when kFollowedShare of its length is within kFollowedRadii of our
/// skeleton. What is not found is missed. An end of ours without a limb is invented when it is
/// farther than kInventedRadii from all of the truth.
///
/// *Radii* are compared at nodes of tubes that are in no junction's ball and within kMatchedRadii
/// of our skeleton.
TruthScore score_against(const Truth& truth, const SkeletonGraph& graph);

}  // namespace zskel::scoring
