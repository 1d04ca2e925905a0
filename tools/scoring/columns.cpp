#include <fmt/format.h>

#include "scoring/table.h"

namespace zskel::scoring {
namespace {

using Value = std::optional<double>;

double number(std::size_t count) {
    return static_cast<double>(count);
}

// A measure that needs the truth.
template <typename Get>
std::function<Value(const Score&)> of_truth(Get get) {
    return [get](const Score& score) -> Value {
        return score.truth ? Value(get(*score.truth)) : std::nullopt;
    };
}

std::vector<Column> shape_columns() {
    return {
        {"nodes", "Size", "nodes", "Nodes of the skeleton.",
         [](const Score& s) { return number(s.nodes); }},
        {"ends", "Size", "ends", "Nodes with one edge.",
         [](const Score& s) { return number(s.ends); }},
        {"topology_wrong", "Topology", "parts, cycles",
         "Connected parts and independent cycles of the skeleton. There should be a part for every "
         "solid of the model and a cycle for every handle of its surface; where that is not so, "
         "what is expected follows.",
         [](const Score& s) { return s.is_topology_right() ? 0.0 : 1.0; }, Worse::Higher, 0.0},
        {"inside", "Inside", "inside, %",
         fmt::format("Share of the skeleton's length inside the model, by winding numbers. "
                     "Anything below {:.2f} % counts as leaving the model.",
                     100 * kInsideBound),
         [](const Score& s) { return s.inside; }, Worse::Lower, kInsideBound, 3, 100.0},
        {"spurs", "Branches", "spurs",
         "End branches shorter than the distance from their inner end to the surface: they do not "
         "leave the ball that fits there, so they tell nothing of the shape.",
         [](const Score& s) { return number(s.spurs); }, Worse::Higher, 0.0},
        {"turn_deg", "Branches", "turn, deg",
         "Mean angle between one step and the next along branches, steps of 1 % of the diagonal: "
         "how smooth the branches are, whatever the number of nodes.",
         [](const Score& s) { return s.turn_deg; }, Worse::Higher, std::nullopt, 1},
        {"off_centre_median", "Off centre", "median",
         "At points 0.5 % apart, 48 rays in the plane across the branch, none longer than three "
         "times the median one: the mean of |a - b| / (a + b) over opposite rays a and b. 0 is the "
         "centre of any section that half a turn leaves as it is, 1 is outside. Here the median of "
         "the points.",
         [](const Score& s) { return s.off_centre_median; }, Worse::Higher, std::nullopt, 3},
        {"off_centre_p90", "Off centre", "90 %", "The value that 90 % of the points stay below.",
         [](const Score& s) { return s.off_centre_p90; }, Worse::Higher, std::nullopt, 3},
    };
}

std::vector<Column> surface_columns() {
    return {
        {"cover_p95", "Coverage", "95 %",
         "Distance from a surface point to the skeleton over half the thickness there (the median "
         "of 24 rays in a cone of 45 degrees round the inward normal, halved): 1 on a tube round "
         "its axis, large on a limb without a branch. The value that 95 % of 4000 points, even by "
         "area, stay below.",
         [](const Score& s) { return s.cover_p95; }, Worse::Higher, std::nullopt, 2},
        {"cover_le2", "Coverage", "to 2, %", "Share of those points where it is at most 2.",
         [](const Score& s) { return s.cover_le2; }, Worse::Lower, std::nullopt, 1, 100.0},
        {"reconstruction", "Rebuilt", "gap, %",
         "Mean distance from the same points to the union of the balls that fit into the model "
         "along the skeleton, in percent of the diagonal: how much of the shape the skeleton and "
         "its radii hold.",
         [](const Score& s) { return s.reconstruction; }, Worse::Higher, std::nullopt, 2, 100.0},
    };
}

std::vector<Column> truth_columns() {
    return {
        {"from_truth", "Truth", "from it, %",
         "Mean distance from the true skeleton to this one, in percent of the diagonal: high when "
         "something is missing.",
         of_truth([](const TruthScore& t) { return t.from_truth; }), Worse::Higher, std::nullopt, 2,
         100.0},
        {"to_truth", "Truth", "to it, %",
         "Mean distance from this skeleton to the true one: high when there is too much.",
         of_truth([](const TruthScore& t) { return t.to_truth; }), Worse::Higher, std::nullopt, 2,
         100.0},
        {"missed", "Truth", "missed",
         fmt::format(
             "True limbs without a branch. A limb with a free end is found when an end of the "
             "skeleton is within {} of the limb's radii of its last third, prolonged by "
             "{} radii since the surface goes on there; one end stands for one limb only. "
             "A limb without a free end is found when half of its length has the skeleton "
             "within one radius.",
             kFoundRadii, kTipRadii),
         of_truth([](const TruthScore& t) { return number(t.missed.size()); }), Worse::Higher, 0.0},
        {"invented", "Truth", "invented",
         "Ends of the skeleton that no true limb accounts for and that are farther than a third "
         "of the true radius from all of the true skeleton: limbs that are not there.",
         of_truth([](const TruthScore& t) { return number(t.invented.size()); }), Worse::Higher,
         0.0},
        {"radius_error", "Truth", "radius, %",
         "Median of |radius / true radius - 1| at true nodes on tubes, outside of junctions' "
         "balls, that the skeleton comes as near to as half a radius. A tube of few faces is "
         "thinner than the balls it was made from, so some error is right.",
         [](const Score& s) { return s.truth ? s.truth->radius_error : std::nullopt; },
         Worse::Higher, std::nullopt, 1, 100.0},
    };
}

std::vector<Column> cost_columns() {
    return {
        {"evaluations", "Cost", "evaluations", "How many times the force was asked for.",
         [](const Score& s) { return s.evaluations; }},
        {"seconds", "Cost", "seconds", "Wall time of the extraction, reading and writing left out.",
         [](const Score& s) { return s.seconds; }, Worse::Neither, std::nullopt, 2},
    };
}

}  // namespace

const std::vector<Column>& columns() {
    static const std::vector<Column> all = [] {
        std::vector<Column> list = shape_columns();
        for (const auto& more : {surface_columns(), truth_columns(), cost_columns()})
            list.insert(list.end(), more.begin(), more.end());
        return list;
    }();
    return all;
}

}  // namespace zskel::scoring
