#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/integer_basis.h"
#include "zskel/mesh/linking.h"
#include "zskel/mesh/loops.h"
#include "zskel/mesh/surface.h"

namespace zskel {

/// A handle by its shortest loop, world space. The loop goes round the handle (its girth) or round
/// the hole that the handle makes, whichever is shorter.
struct SmallHandle {
    double radius = 0.0;  ///< the loop's length, along mesh edges, over 2 pi
    Vec3 position{0.0f};  ///< mean of the loop's vertices
    bool is_cut = false;  ///< the loop goes round the handle, not round the hole
};

/// Small handles, and what ignoring them means: the solid is cut at a thin handle, and a narrow
/// hole is filled.
struct SmallHandles {
    std::vector<SmallHandle> handles;  ///< smallest first
    std::vector<IntegerBasis::Vector>
        loops;  ///< of each: how often it runs along each loop of the system
};

/// The handles with a loop of at most 2 pi `max_radius`, found for certain where it is a twentieth
/// shorter. Handles are counted as independent classes, and those that are cut and filled do not
/// meet.
/// @param links  linking numbers of the system's loops: pushed inside, by the loops themselves.
/// Work: the vertices within half a loop's length of each of the places, an eighth of the radius
/// apart, that every loop has to pass.
SmallHandles find_small_handles(const Surface& surface, const LoopSystem& system,
                                const std::vector<IntegerBasis::Vector>& links, double max_radius);

}  // namespace zskel
