#pragma once

#include <cstdint>
#include <vector>

#include "zskel/skeleton/coverage.h"
#include "zskel/skeleton/surface_walks.h"

namespace zskel {

/// A connected part of the surface that lies far from the skeleton, measured in its own depth (half
/// the local thickness there).
struct FarPatch {
    std::vector<std::uint32_t> seeds;
    Vec3 centre{0.0f};           ///< area-weighted mean of its places, world space
    float depth = 0.0f;          ///< area-weighted mean
    double area_depths = 0.0;    ///< its area, in squares of the depth
    std::uint32_t farthest = 0;  ///< the seed farthest from the skeleton
};

/// Finds what a skeleton that grows still lies far from.
class FarPatches {
  public:
    /// @param context  must outlive this.
    explicit FarPatches(const ClusterContext& context);

    /// Whether a seed's surface is farther from something than its depth allows.
    bool is_far(std::uint32_t seed, float distance) const;

    /// Largest first.
    std::vector<FarPatch> find(const Coverage& coverage) const;

    float area(std::uint32_t seed) const { return areas_[seed]; }

  private:
    FarPatch measure(std::vector<std::uint32_t> seeds, const Coverage& coverage) const;

    std::vector<float> areas_;   // of the surface that belongs to each seed
    std::vector<float> depths_;  // under each seed
    std::vector<std::vector<std::uint32_t>> neighbours_;
};

}  // namespace zskel
