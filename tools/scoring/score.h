#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "scoring/skeleton_file.h"
#include "scoring/subject.h"
#include "scoring/truth.h"
#include "zskel/skeleton/graph.h"

namespace zskel::scoring {

/// Below this share of its length inside, a skeleton counts as leaving the model.
inline constexpr double kInsideBound = 0.9999;

/// What a skeleton is worth. Lengths are in diagonals; each measure is explained where the table's
/// columns are listed (columns.cpp), which is also what the page says.
struct Score {
    std::size_t nodes = 0;
    std::size_t ends = 0;
    std::size_t spurs = 0;
    GraphTopology topology;
    std::size_t expected_components = 0;
    std::optional<std::size_t> expected_cycles;  ///< none: the surface has no genus
    double inside = 0.0;
    std::optional<double> off_centre_median;  ///< none for a skeleton without length
    std::optional<double> off_centre_p90;
    std::optional<double> cover_p95;
    std::optional<double> cover_le2;
    std::optional<double> reconstruction;
    std::optional<double> turn_deg;
    std::optional<TruthScore> truth;  ///< where the true skeleton is known
    std::optional<double> evaluations;
    std::optional<double> seconds;

    bool is_topology_right() const {
        return topology.components == expected_components &&
               topology.cycles == expected_cycles.value_or(topology.cycles);
    }
};

/// Measures a skeleton, in model space, against its model. The same input gives the same score.
/// @param truth  in model space; may be null.
/// @throws InputError for a skeleton without nodes.
Score score_skeleton(const Subject& subject, const SkeletonFile& skeleton, const Truth* truth);

/// Distance between two skeletons of one model, in diagonals, by points 0.1 % apart.
struct SkeletonDistance {
    double mean = 0.0;       ///< of both ways' means
    double hausdorff = 0.0;  ///< the largest, either way
};
SkeletonDistance compare_curves(const Subject& subject, const SkeletonGraph& a,
                                const SkeletonGraph& b);

}  // namespace zskel::scoring
