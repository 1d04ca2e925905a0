#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// Why no more seeds were spread.
enum class SpreadEnd : std::uint8_t {
    Spacing,      ///< they are near enough together for the thinnest limb
    EveryVertex,  ///< there is one at every vertex
    Limit,        ///< there are max_seeds
};
std::string_view name_of(SpreadEnd end);

/// Which vertices carry a seed, and which seed every other vertex belongs to.
struct SeedSpread {
    std::vector<std::uint32_t> vertices;  ///< one a seed, in the order in which they were chosen
    std::vector<std::uint32_t> seed_of;   ///< of every vertex: the seed nearest along the surface
    std::vector<std::uint32_t>
        parent;  ///< of every vertex: the next one on its way to its seed; itself at one
    double spacing_thickness =
        0.0;  ///< what is left: the largest distance to a seed over the thickness there
    SpreadEnd end = SpreadEnd::Spacing;
};

/// When seeds are near enough together, in local thicknesses: finely spread over a body with some
/// limbs, coarsely over what is thin all over, as a tree of vessels.
struct SpreadOptions {
    std::size_t min_seeds = 300;    ///< so many, or every vertex;
    double fine_thickness = 0.22;   ///< then until no vertex is farther from a seed than this,
    std::size_t many_seeds = 1000;  ///< or, once there are so many,
    double coarse_thickness = 1.0;  ///< than this;
    std::size_t max_seeds = 20000;  ///< and up to so many
};

/// Farthest-point sampling along the surface's edges, distances divided by the thickness there, so
/// that thin limbs are not passed over. Every component gets a seed. O((n log n) log k) on even
/// meshes for k seeds of n vertices.
/// @param thickness  of every vertex, world units, positive.
/// @see Eldar et al. 1997 for farthest points; the weight is ours.
SeedSpread spread_seeds(const Surface& surface, std::span<const float> thickness,
                        const SpreadOptions& options);

}  // namespace zskel
