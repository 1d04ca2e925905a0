#include "zskel/skeleton/settle.h"

#include <algorithm>
#include <cmath>

namespace zskel {
namespace {

// An eye inside a solid sees its surface from behind.
constexpr float kLeastBackFraction = 0.5f;

// A seed on its way: `next` waits to be looked from, `force` was met at `seed.position`.
struct Walker {
    std::uint32_t index;
    Vec3 next;
    Vec3 force{0.0f};
    bool started = false;
};

class PaperWalk {
  public:
    PaperWalk(std::span<const Seed> seeds, const PaperStepOptions& options)
        : options_(options), settled_(seeds.size()) {
        walkers_.reserve(seeds.size());
        for (std::uint32_t i = 0; i < seeds.size(); ++i) {
            settled_[i].position = seeds[i].position;
            walkers_.push_back({i, seeds[i].position});
        }
    }

    bool is_done() const { return walkers_.empty(); }
    double done_share() const {
        return 1.0 - static_cast<double>(walkers_.size()) / static_cast<double>(settled_.size());
    }

    void round(VisibilitySource& source) {
        eyes_.clear();
        for (const Walker& walker : walkers_) eyes_.push_back(walker.next);
        records_.resize(eyes_.size());
        source.look(eyes_, records_);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < walkers_.size(); ++i) {
            if (advance(walkers_[i], records_[i])) walkers_[kept++] = walkers_[i];
        }
        walkers_.resize(kept);
    }

    std::vector<SettledSeed> take() { return std::move(settled_); }

  private:
    // Judges what the walker met at `next`; true when it goes on.
    bool advance(Walker& walker, const EyeRecord& met) {
        SettledSeed& seed = settled_[walker.index];
        ++seed.evaluations;
        if (met.hit_fraction == 0.0f) return rest(seed, SeedState::NoHits);
        if (met.back_fraction < kLeastBackFraction) return rest(seed, SeedState::LeftMesh);
        const float strength = glm::length(met.force);
        // On the surface itself there is no direction to go.
        if (!std::isfinite(strength)) return rest(seed, SeedState::LeftMesh);
        if (walker.started) {
            if (strength > glm::length(walker.force)) return rest(seed, SeedState::Converged);
            ++seed.steps;
        }
        seed.position = walker.next;
        if (options_.keep_paths) seed.path.push_back(seed.position);
        if (strength == 0.0f) return rest(seed, SeedState::Converged);
        if (seed.steps >= static_cast<std::uint32_t>(options_.max_steps))
            return rest(seed, SeedState::StepLimit);
        walker.started = true;
        walker.force = met.force;
        walker.next =
            seed.position + met.force / strength * static_cast<float>(options_.step_world);
        return true;
    }

    static bool rest(SettledSeed& seed, SeedState state) {
        seed.state = state;
        return false;
    }

    const PaperStepOptions& options_;
    std::vector<SettledSeed> settled_;
    std::vector<Walker> walkers_;
    std::vector<Vec3> eyes_;
    std::vector<EyeRecord> records_;
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
    PaperWalk walk(seeds, options);
    while (!walk.is_done()) {
        walk.round(source);
        if (progress) progress(walk.done_share());
    }
    return walk.take();
}

}  // namespace zskel
