#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// 2g loops over a closed surface (g the sum of its components' genera) that every closed walk is
/// homologous to a sum of, and the coordinates of walks in them.
struct LoopSystem {
    /// The ends of the loops' own edges, met on a walk round the surface cut open along all loops:
    /// each loop twice, once with either sign.
    struct Side {
        std::uint32_t loop;
        std::int32_t sign;
    };

    std::vector<std::vector<std::uint32_t>> loops;  ///< vertices in order, longest loop first
    std::vector<Side> sides;
    /// Of every edge of Surface::edges: crossing it from its low to its high vertex adds the sides
    /// from the first number up to the second; where the first is the greater, it takes those away.
    std::vector<glm::uvec2> edge_span;
};

/// A shortest-path tree and a dual tree of greatest loops; the edges in neither close the loops.
/// O(n log n). Nothing when the surface is not closed, oriented and manifold.
/// @see Erickson and Whittlesey 2005.
std::optional<LoopSystem> find_loops(const Surface& surface);

/// The closed walk from where two ways to one root meet along the first, over the edge between
/// their first vertices, and back along the second; it starts at the meeting point.
std::vector<std::uint32_t> joined_ways(std::vector<std::uint32_t> a, std::vector<std::uint32_t> b);

}  // namespace zskel
