#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// End points gathered into nodes.
struct Clusters {
    std::vector<std::uint32_t> of_point;  ///< the cluster of every point
    std::vector<Vec3> centers;            ///< mean of the points of each cluster
};

struct ClusterOptions {
    double range_world = 0.06;  ///< clusters whose centres are nearer than this become one
};

/// Merges clusters that a mesh edge joins, nearest centres first, while they are within the range.
/// Starts from every point alone. O(n log n) for n edges.
/// @param links  pairs of points that neighbour each other on the surface.
/// @see Wu et al. 2003, section 4.2, which leaves the manner open: chains of single links would
///      swallow whole limbs, and a grid splits nodes; centres keep clusters about one range apart.
Clusters cluster_minima(std::span<const Vec3> points, std::span<const glm::uvec2> links,
                        const ClusterOptions& options);

/// The same with a range for each point: two clusters merge within the smaller of their members'
/// mean ranges, the pair first that is nearest in terms of it.
Clusters cluster_minima(std::span<const Vec3> points, std::span<const glm::uvec2> links,
                        std::span<const float> ranges);

}  // namespace zskel
