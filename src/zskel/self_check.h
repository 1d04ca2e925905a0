#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "zskel/mesh/solid.h"
#include "zskel/skeleton/graph.h"
#include "zskel/skeleton/method.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// What was found of a finished skeleton, beside what was to be expected.
struct SelfCheck {
    std::size_t components = 0;
    std::size_t expected_components = 0;  ///< one for each solid
    std::size_t cycles = 0;
    std::optional<std::size_t> expected_cycles;  ///< nothing where handles were not looked for, or
                                                 ///< not all parts are closed
    std::optional<double> share_inside;  ///< of the edges' length in the closed solids; winding
                                         ///< number not 0; of a skeleton without edges,
                                         ///< whether its nodes are. Nothing where none is closed
    double least_clearance = 0.0;  ///< model units: from nodes and middles of edges to the surface;
                                   ///< negative when one of them is outside
    std::vector<std::string> failures;  ///< what is not as expected, in words; empty: sound
};

/// Gathers the checks of a skeleton's solids. Edges that meet no triangle lie on one side as a
/// whole, by the winding number about one point of each chain of them; the others are looked at in
/// 64 places each.
class SkeletonChecker {
  public:
    /// @param query  of the solid's surface.
    void add(const Solid& solid, const SurfaceQuery& query, const SolidSkeleton& skeleton);

    /// @param graph  of all solids.
    SelfCheck finish(const SkeletonGraph& graph) const;

  private:
    std::size_t solids_ = 0;
    std::size_t closed_ = 0;
    std::size_t expected_cycles_ = 0;
    bool knows_cycles_ = true;
    double length_ = 0.0;  // model units, of closed solids
    double inside_ = 0.0;
    double least_clearance_ = std::numeric_limits<double>::infinity();
};

}  // namespace zskel
