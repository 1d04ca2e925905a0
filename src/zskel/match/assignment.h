#pragma once

#include <cstdint>
#include <vector>

namespace zskel {

/// Which column each row takes, so that the costs sum to the least; each column once.
/// @param cost  n x n, row by row; finite.
/// @see Kuhn 1955; shortest augmenting paths as Jonker and Volgenant 1987. O(n^3).
std::vector<std::uint32_t> cheapest_assignment(const std::vector<double>& cost, std::size_t n);

}  // namespace zskel
