#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Two seeds that came to rest close together though their patches on the surface do not meet: the
/// near and the far side of a limb. Every end on the walk between them lies in the inscribed ball
/// at the first end, so going by the walk or straight across is the same to the solid's topology.
struct Shortcut {
    std::vector<std::uint32_t>
        walk;  ///< seeds, each a neighbour of the one before; first and last are joined
};

/// @param links   pairs of seeds whose patches meet.
/// @param radii   of the inscribed ball at every end.
/// @param ranges  how near ends must be to be joined.
std::vector<Shortcut> find_shortcuts(std::span<const Vec3> ends, std::span<const glm::uvec2> links,
                                     std::span<const float> radii, std::span<const float> ranges);

}  // namespace zskel
