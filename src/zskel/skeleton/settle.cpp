#include "zskel/skeleton/settle.h"

#include <algorithm>
#include <cmath>

#include "zskel/skeleton/walk.h"

namespace zskel {
namespace {

// A seed on its way: `tried` waits to be looked from, `force` was met at `seed.position`.
struct Walker {
    std::uint32_t index = 0;
    Vec3 tried{0.0f};
    Vec3 force{0.0f};
    bool started = false;
};

// A seed with no farther to go than this share of a step is at rest. Near the axis of a tube of
// radius R and the middle of a ball the force is (distance) / (3 R^2); where it is less than that
// of half a step, steps of a fixed length swing across the axis wider and wider, from a map's
// rounding on, and would end anywhere. At a third the swing has no time to grow.
constexpr float kLeastShare = 0.3f;
// As long as it is near the axis, that is: at a wall the force is a sixth of 1 / (distance).
constexpr float kNearAxis = 0.02f;

class PaperWalk {
  public:
    explicit PaperWalk(const PaperStepOptions& options) : options_(options) {}

    // Judges what the walker met at `tried`; true when it goes on.
    bool advance(Walker& walker, SettledSeed& seed, const EyeRecord& met) const {
        if (met.hit_fraction == 0.0f) return rest(seed, SeedState::NoHits);
        if (met.back_fraction < kLeastBackFraction) return rest(seed, SeedState::LeftMesh);
        const float strength = glm::length(met.force);
        // On the surface itself there is no direction to go.
        if (!std::isfinite(strength)) return rest(seed, SeedState::LeftMesh);
        if (walker.started) {
            if (strength > glm::length(walker.force)) return rest(seed, SeedState::Converged);
            ++seed.steps;
        }
        seed.position = walker.tried;
        if (options_.keep_paths) seed.path.push_back(seed.position);
        if (is_spent(strength, met.nearest)) return rest(seed, SeedState::Converged);
        if (seed.steps >= static_cast<std::uint32_t>(options_.max_steps))
            return rest(seed, SeedState::StepLimit);
        walker.started = true;
        walker.force = met.force;
        walker.tried =
            seed.position + met.force / strength * static_cast<float>(options_.step_world);
        return true;
    }

    // Each goes its own way.
    void end_round(std::span<const Walker>, std::span<SettledSeed>, std::span<std::uint8_t>) const {
    }

  private:
    bool is_spent(float strength, float radius) const {
        const float way_left = 3.0f * radius * radius * strength;
        return strength * radius <= kNearAxis &&
               way_left <= kLeastShare * static_cast<float>(options_.step_world);
    }

    static bool rest(SettledSeed& seed, SeedState state) {
        seed.state = state;
        return false;
    }

    const PaperStepOptions& options_;
};

}  // namespace

std::string_view name_of(SeedState state) {
    switch (state) {
        case SeedState::Converged:
            return "converged";
        case SeedState::StepLimit:
            return "step_limit";
        case SeedState::LeftMesh:
            return "left_mesh";
        case SeedState::NoHits:
            return "no_hits";
    }
    return "";
}

std::vector<SettledSeed> settle_seeds(VisibilitySource& source, std::span<const Seed> seeds,
                                      const PaperStepOptions& options,
                                      const SettleProgress& progress) {
    return walk_to_rest<Walker>(source, seeds, PaperWalk(options), progress);
}

}  // namespace zskel
