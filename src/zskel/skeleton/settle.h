#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "zskel/skeleton/seeds.h"
#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// How a seed came to rest.
enum class SeedState : std::uint8_t {
    Converged,  ///< the next step would meet a greater force; or it came to where others rest
    StepLimit,  ///< still descending after max_steps
    LeftMesh,   ///< it sees more front faces than back faces
    NoHits,     ///< it sees nothing
};
std::string_view name_of(SeedState state);

struct SettledSeed {
    Vec3 position{0.0f};  ///< where it came to rest, world space
    SeedState state = SeedState::Converged;
    std::uint32_t steps = 0;
    std::uint32_t evaluations = 0;
    std::vector<Vec3> path;  ///< start to end; empty unless paths are kept
};

struct PaperStepOptions {
    double step_world = 0.0025;
    int max_steps = 1000;
    bool keep_paths = false;
};

/// Called between rounds with the share of seeds at rest.
using SettleProgress = std::function<void(double)>;

/// Moves every seed by p += normalize(force) * step until the force would grow: the least force
/// along the way is where it rests. All seeds that still move are evaluated together, one batch a
/// round.
/// @throws GlError when a GL pass fails; whatever `progress` throws.
/// @see Wu et al. 2003, section 4.1, with its stop rule as printed; differs: a force that is spent
/// within a third of a step counts as none.
std::vector<SettledSeed> settle_seeds(VisibilitySource& source, std::span<const Seed> seeds,
                                      const PaperStepOptions& options,
                                      const SettleProgress& progress = {});

}  // namespace zskel
