#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Pairs of clusters that some mesh edge joins, one end in each; lower number first, sorted, each
/// once.
/// @see Wu et al. 2003, formula 2, read as an intersection: N(D^-1(q_i)) with D^-1(q_j). The union
/// that is
///      printed is never empty and would join everything.
std::vector<glm::uvec2> connect_clusters(std::span<const std::uint32_t> cluster_of_point,
                                         std::span<const glm::uvec2> links);

/// Of the given edges, those of a spanning forest of least total length: what is left when every
/// cycle has been opened at its longest edge. Stands for the paper's removal by hand on shapes
/// without handles.
std::vector<glm::uvec2> spanning_forest(std::span<const Vec3> centers,
                                        std::span<const glm::uvec2> edges);

}  // namespace zskel
