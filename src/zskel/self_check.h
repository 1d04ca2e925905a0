#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "zskel/mesh/solid.h"
#include "zskel/skeleton/method.h"

namespace zskel {

/// What was found of a finished skeleton, beside what was to be expected.
struct SelfCheck {
    std::size_t components = 0;
    std::size_t expected_components = 0;  ///< one for each solid
    std::size_t cycles = 0;
    std::optional<std::size_t> expected_cycles;  ///< nothing where handles were not looked for, or
                                                 ///< not all parts are closed
    std::optional<double> share_inside;  ///< of the edges' length in the closed solids; winding
                                         ///< number not 0. Nothing where none is closed
    double least_clearance = 0.0;  ///< model units: from nodes and middles of edges to the surface;
                                   ///< negative when one of them is outside
    std::vector<std::string> failures;  ///< what is not as expected, in words; empty: sound
};

/// How much of a solid's skeleton lies inside, and how near to the surface it comes.
struct InsideCheck {
    double length = 0.0;  ///< world units
    double inside = 0.0;
    double least_clearance = 0.0;
};

/// Edges that meet no triangle lie on one side as a whole, by the winding number about one point of
/// each chain of them; the others are looked at in 64 places each. On an open solid all counts as
/// inside.
InsideCheck check_inside(const Solid& solid, const SolidSkeleton& skeleton);

}  // namespace zskel
