#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// The numbers of the triangles that pass through another one, ascending. Pairs that only touch,
/// lie in one plane, or share an edge do not count; signs are those of double arithmetic.
/// @param triangles  welded: neighbours have the same corners.
/// @param most_pairs  whose boxes meet: about 20 a triangle on a usual surface, nearly all that
///                    there are among slivers in one plane.
/// @return none when there are more pairs.
std::optional<std::vector<std::uint32_t>> crossing_triangles(
    const std::vector<DVec3>& positions, const std::vector<Triangle>& triangles,
    std::size_t most_pairs = std::numeric_limits<std::size_t>::max());

/// A bound for `most_pairs` that keeps the work linear.
inline std::size_t bearable_pairs(std::size_t triangles) {
    return 1'000'000 + 200 * triangles;
}

}  // namespace zskel
