// Near the axis of a sphere, a cylinder and a slab alike the mean force is -x / (3 R^2), so a
// Newton step on it lands on the axis; the paper's fixed steps need some 50 evaluations for the
// same way.
#include "zskel/skeleton/newton.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "zskel/core/eigen3.h"
#include "zskel/skeleton/rest_places.h"
#include "zskel/skeleton/walk.h"

namespace zskel {
namespace {

constexpr int kMaxHalvings = 4;

// A seed on its way. `here` was accepted; `tried` waits to be looked from.
struct Walker {
    std::uint32_t index = 0;
    Vec3 tried{0.0f};
    Vec3 here{0.0f};
    EyeRecord met;    // at `here`
    DVec3 step{0.0};  // from `here` to `tried`
    DVec3 last_step{0.0};
    std::array<DVec3, 3> axes{};  // that the step moves in, and how many
    int axis_count = 0;
    double damping = 1.0;
    int halvings = 0;
    bool started = false;
    bool jumped = false;
};

class NewtonWalk {
  public:
    explicit NewtonWalk(const NewtonOptions& options)
        : options_(options), places_(options.core_nearest) {}

    // Judges what was met at `tried`; true when the walker goes on.
    bool advance(Walker& walker, SettledSeed& seed, const EyeRecord& met) const {
        const bool is_outside = met.hit_fraction == 0.0f || met.back_fraction < kLeastBackFraction;
        if (!walker.started && is_outside) {
            seed.path.push_back(walker.tried);
            return rest(seed, met.hit_fraction == 0.0f ? SeedState::NoHits : SeedState::LeftMesh);
        }
        if (walker.started && (is_outside || !is_descent(walker, met))) return halve(walker, seed);
        accept(walker, seed, met);
        if (seed.steps >= static_cast<std::uint32_t>(options_.max_steps))
            return rest(seed, seed.steps > 0 ? SeedState::StepLimit : SeedState::Converged);
        return plan(walker, seed);
    }

    // What has come into the core of a place at rest would come to rest beside it: it does there.
    void end_round(std::span<const Walker> walkers, std::span<SettledSeed> settled,
                   std::span<std::uint8_t> goes_on) {
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            const SettledSeed& seed = settled[walkers[i].index];
            if (goes_on[i] == 0 && seed.state == SeedState::Converged)
                places_.add(seed.position, walkers[i].met.nearest);
        }
        parallel_for(walkers.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (goes_on[i] == 0) continue;
                SettledSeed& seed = settled[walkers[i].index];
                const std::optional<Vec3> place = places_.find(seed.position);
                if (!place) continue;
                goes_on[i] = 0;
                seed.position = *place;
                seed.path.push_back(*place);
                rest(seed, SeedState::Converged);
            }
        });
    }

  private:
    // Whether the force grew in the axes that the step moved in. The jump may land anywhere in the
    // chord's middle, where forces from both sides compare.
    static bool is_descent(const Walker& walker, const EyeRecord& met) {
        double before = 0.0;
        double after = 0.0;
        for (int k = 0; k < walker.axis_count; ++k) {
            const DVec3& axis = walker.axes[static_cast<std::size_t>(k)];
            before += std::pow(glm::dot(DVec3(walker.met.force), axis), 2.0);
            after += std::pow(glm::dot(DVec3(met.force), axis), 2.0);
        }
        return after <= before;
    }

    bool halve(Walker& walker, SettledSeed& seed) const {
        const bool is_short = glm::length(walker.step) < 2.0 * stop_length(walker);
        if (++walker.halvings > kMaxHalvings || is_short) return rest(seed, SeedState::Converged);
        walker.step *= 0.5;
        walker.tried = walker.here + Vec3(walker.step);
        return true;
    }

    static void accept(Walker& walker, SettledSeed& seed, const EyeRecord& met) {
        if (walker.started) ++seed.steps;
        walker.started = true;
        walker.here = walker.tried;
        walker.met = met;
        walker.last_step = walker.step;
        walker.halvings = 0;
        seed.position = walker.here;
        seed.path.push_back(walker.here);
    }

    bool plan(Walker& walker, SettledSeed& seed) const {
        walker.step = walker.jumped ? newton_step(walker) : chord_jump(walker);
        walker.jumped = true;
        if (glm::length(walker.step) < stop_length(walker)) return rest(seed, SeedState::Converged);
        walker.tried = walker.here + Vec3(walker.step);
        return true;
    }

    double stop_length(const Walker& walker) const {
        return std::min(options_.stop_world,
                        options_.stop_nearest * static_cast<double>(walker.met.nearest));
    }

    // To the middle of the free way ahead.
    static DVec3 chord_jump(Walker& walker) {
        const DVec3 force(walker.met.force);
        const double strength = glm::length(force);
        if (!(strength > 0.0) || !std::isfinite(walker.met.clearance)) return DVec3(0.0);
        walker.axes[0] = force / strength;
        walker.axis_count = 1;
        return walker.axes[0] * (0.5 * static_cast<double>(walker.met.clearance));
    }

    DVec3 newton_step(Walker& walker) const {
        const Eigen3 eigen = eigen_symmetric(walker.met.jacobian);
        const DVec3 force(walker.met.force);
        const bool use_third = eigen.values[2] > options_.third_axis * eigen.values[1];
        const double floor = options_.eigenvalue_floor * eigen.values[0];
        const bool is_sheet = std::abs(eigen.values[1]) < floor;
        walker.axis_count = is_sheet ? 1 : use_third ? 3 : 2;
        walker.axes = eigen.vectors;
        if (!(floor > 0.0)) return DVec3(0.0);
        DVec3 step(0.0);
        for (int k = 0; k < walker.axis_count; ++k) {
            const auto i = static_cast<std::size_t>(k);
            step += eigen.vectors[i] *
                    (glm::dot(force, eigen.vectors[i]) / std::max(eigen.values[i], floor));
        }
        if (glm::dot(step, walker.last_step) < 0.0) walker.damping *= options_.reversal_damping;
        step *= walker.damping;
        const double longest = options_.trust_nearest * static_cast<double>(walker.met.nearest);
        const double length = glm::length(step);
        return length > longest ? step * (longest / length) : step;
    }

    static bool rest(SettledSeed& seed, SeedState state) {
        seed.state = state;
        return false;
    }

    const NewtonOptions& options_;
    RestPlaces places_;
};

}  // namespace

std::vector<SettledSeed> settle_seeds_newton(VisibilitySource& source, std::span<const Seed> seeds,
                                             const NewtonOptions& options,
                                             const SettleProgress& progress) {
    return walk_to_rest<Walker>(source, seeds, NewtonWalk(options), progress);
}

}  // namespace zskel
