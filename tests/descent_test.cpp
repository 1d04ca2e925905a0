// Newton's walk, rebuilt from its paths and from what every eye saw.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "support/models.h"
#include "support/shapes.h"
#include "zskel/core/eigen3.h"
#include "zskel/skeleton/newton.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"

using namespace zskel;

namespace {

using Key = std::tuple<float, float, float>;

Key key_of(const Vec3& p) {
    return {p.x, p.y, p.z};
}

// Passes on, and remembers what was seen from where.
class RecordingSource : public VisibilitySource {
  public:
    explicit RecordingSource(VisibilitySource& source)
        : VisibilitySource(source.solid(), source.directions()), source_(source) {}

    void look(std::span<const Vec3> eyes, std::span<EyeRecord> records) override {
        source_.look(eyes, records);
        for (std::size_t i = 0; i < eyes.size(); ++i) seen_[key_of(eyes[i])] = records[i];
    }
    void render(std::span<const Vec3> eyes, MapBatch& maps) override { source_.render(eyes, maps); }
    const EyeRecord& seen_from(const Vec3& eye) const { return seen_.at(key_of(eye)); }

  private:
    VisibilitySource& source_;
    std::map<Key, EyeRecord> seen_;
};

// A force that waves through space, with a Jacobian that is not its own and has any signs.
class WavySource : public VisibilitySource {
  public:
    explicit WavySource(const Surface& surface)
        : VisibilitySource(surface, cube_directions(kMinFacePx)) {}

    void look(std::span<const Vec3> eyes, std::span<EyeRecord> records) override {
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            const Vec3 p = eyes[i] * 30.0f;
            EyeRecord record;
            record.force = {std::sin(p.y) + 0.2f, std::sin(p.z + 1.0f), std::sin(p.x + 2.0f)};
            for (std::size_t k = 0; k < 6; ++k)
                record.jacobian[k] = 20.0f * std::sin(p.x + 2.0f * p.y + 3.0f * p.z + 2.0f * k);
            record.nearest = record.clearance = 0.1f;
            record.back_fraction = record.hit_fraction = 1.0f;
            records[i] = record;
        }
    }
    void render(std::span<const Vec3>, MapBatch&) override {}
};

struct Walk {
    std::size_t jumps = 0;
    std::size_t steps = 0;
    std::size_t indefinite = 0;  // steps taken where the Jacobian has a negative eigenvalue
    std::size_t bent = 0;        // of these, in an axis whose eigenvalue is negative
    std::size_t uphill = 0;      // steps or jumps against the force
    std::size_t refused = 0;     // tries that were not taken
    std::size_t grown = 0;       // after which the force, in the axes of the step, is greater
};

double squared_in(const EyeRecord& record, std::span<const DVec3> axes) {
    double sum = 0.0;
    for (const DVec3& axis : axes) {
        const double part = glm::dot(DVec3(record.force), axis);
        sum += part * part;
    }
    return sum;
}

void judge(const RecordingSource& source, const Vec3& from, const Vec3& to,
           std::span<const DVec3> axes, Walk& walk) {
    const EyeRecord& before = source.seen_from(from);
    const EyeRecord& after = source.seen_from(to);
    walk.uphill += glm::dot(DVec3(to) - DVec3(from), DVec3(before.force)) > 0.0 ? 0 : 1;
    walk.grown += squared_in(after, axes) > squared_in(before, axes) ? 1 : 0;
}

// Along the strongest of the Jacobian's axes a step moves always.
std::size_t axes_of_step(const Eigen3& eigen, const NewtonOptions& options) {
    if (std::abs(eigen.values[1]) < options.eigenvalue_floor * eigen.values[0]) return 1;
    return eigen.values[2] > options.third_axis * eigen.values[1] ? 3 : 2;
}

// The jump moves along the force.
Walk judge_paths(const RecordingSource& source, std::span<const SettledSeed> settled,
                 const NewtonOptions& options) {
    Walk walk;
    for (const SettledSeed& seed : settled) {
        for (std::size_t i = 0; i + 1 < seed.path.size(); ++i) {
            const EyeRecord& here = source.seen_from(seed.path[i]);
            if (i == 0) {
                const DVec3 along = glm::normalize(DVec3(here.force));
                judge(source, seed.path[0], seed.path[1], std::span(&along, 1), walk);
                ++walk.jumps;
                continue;
            }
            const Eigen3 eigen = eigen_symmetric(here.jacobian);
            const std::size_t axes = axes_of_step(eigen, options);
            judge(source, seed.path[i], seed.path[i + 1], std::span(eigen.vectors).first(axes),
                  walk);
            walk.bent += eigen.values[axes - 1] < 0.0 ? 1 : 0;
            walk.indefinite += eigen.values[2] < 0.0 ? 1 : 0;
            ++walk.steps;
        }
    }
    return walk;
}

Walk judge_walk(VisibilitySource& source, std::span<const Seed> seeds) {
    RecordingSource recording(source);
    NewtonOptions options;
    options.core_nearest = 0.0;  // to join another is no step
    const auto settled = settle_seeds_newton(recording, seeds, options);
    Walk walk = judge_paths(recording, settled, options);
    for (const SettledSeed& seed : settled) walk.refused += seed.evaluations - seed.path.size();
    MESSAGE(walk.jumps, " jumps, ", walk.steps, " steps, ", walk.indefinite,
            " of them where the Jacobian is indefinite, ", walk.bent, " in such an axis; ",
            walk.refused, " tries refused");
    CHECK(walk.indefinite > 0);
    CHECK(walk.uphill == 0);
    CHECK(walk.grown == 0);
    return walk;
}

}  // namespace

TEST_CASE("settle_seeds_newton: every step on a horse goes with the force and lessens it") {
    const PreparedSurface prepared = test::model("horse");
    const auto rays = make_ray_source(prepared.surface, cube_directions(16));
    const auto seeds = test::some_seeds(prepared.surface, 2);
    const Walk walk = judge_walk(*rays, seeds);
    CHECK(walk.jumps == seeds.size());
    CHECK(walk.steps > seeds.size());
}

TEST_CASE("settle_seeds_newton: what comes into the core of a place at rest ends there") {
    const PreparedSurface prepared = test::model("horse");
    const auto rays = make_ray_source(prepared.surface, cube_directions(16));
    const auto seeds = test::some_seeds(prepared.surface, 2);
    RecordingSource recording(*rays);
    NewtonOptions options;
    const auto settled = settle_seeds_newton(recording, seeds, options);
    std::set<Key> places;  // that seeds came to by themselves
    std::size_t evaluations = 0;
    for (const SettledSeed& seed : settled) {
        evaluations += seed.evaluations;
        if (seed.path.size() == seed.steps + 1) places.insert(key_of(seed.position));
    }
    std::size_t joined = 0;
    for (const SettledSeed& seed : settled) {
        CHECK(seed.path.back() == seed.position);
        if (seed.path.size() == seed.steps + 1) continue;
        ++joined;
        REQUIRE(seed.path.size() == seed.steps + 2);
        CHECK(seed.state == SeedState::Converged);
        CHECK(places.contains(key_of(seed.position)));
        const double core =
            options.core_nearest * static_cast<double>(recording.seen_from(seed.position).nearest);
        CHECK(static_cast<double>(glm::distance(seed.path[seed.steps], seed.position)) <=
              1.00001 * core);
    }
    CHECK(joined > 50);
    options.core_nearest = 0.0;
    std::size_t alone = 0;
    for (const SettledSeed& seed : settle_seeds_newton(*rays, seeds, options)) {
        alone += seed.evaluations;
        CHECK(seed.path.size() == seed.steps + 1);
    }
    CHECK(evaluations < alone - joined / 2);
}

TEST_CASE("settle_seeds_newton: within a sheet a seed goes to its middle, and stays there") {
    Mesh plate = test::cube();
    for (int i = 0; i < 4; ++i) plate = test::subdivided(plate, [](const DVec3& p) { return p; });
    for (DVec3& p : plate.positions) p.z *= 0.05;
    const PreparedSurface prepared = prepare_surface(plate);
    const Vec3 middle = prepared.surface.world_from_model.to_world(DVec3(0.0));
    const auto half = static_cast<float>(0.5 * prepared.surface.world_from_model.scale);
    const auto rays = make_ray_source(prepared.surface, cube_directions(16));
    const auto seeds = test::some_seeds(prepared.surface, 1);
    const auto settled = settle_seeds_newton(*rays, seeds, {});
    std::size_t inner = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const Vec3 start = (seeds[i].position - middle) / half;
        const Vec3 end = (settled[i].position - middle) / half;
        if (std::max(std::abs(start.x), std::abs(start.y)) > 0.7f) continue;
        CHECK(settled[i].state == SeedState::Converged);
        CHECK(std::abs(end.z) < 0.005f);
        CHECK(std::hypot(end.x - start.x, end.y - start.y) < 0.05f);
        ++inner;
    }
    CHECK(inner > 100);
}

TEST_CASE("settle_seeds_newton: so does every step on a force whose Jacobian misleads") {
    const PreparedSurface prepared = prepare_surface(test::sphere(0.5, 3));
    WavySource wavy(prepared.surface);
    const Walk walk = judge_walk(wavy, test::some_seeds(prepared.surface, 1));
    CHECK(walk.bent > 0);
    CHECK(walk.refused > 0);
}
