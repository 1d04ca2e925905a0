#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/parallel.h"
#include "zskel/skeleton/settle.h"

namespace zskel {

/// An eye inside a solid sees its surface from behind: with a smaller share of back faces it has
/// left.
inline constexpr float kLeastBackFraction = 0.5f;

/// Lets all seeds look together, one batch a round, until each is at rest.
/// @tparam Walker  a seed on its way: `index`, and the point `tried` that it waits to look from.
/// @tparam Walk    has `bool advance(Walker&, SettledSeed&, const EyeRecord&) const`, which judges
///                 what was met at `tried`; true when the seed goes on. And `void end_round(
///                 std::span<const Walker>, std::span<SettledSeed>, std::span<std::uint8_t>)`,
///                 which may stop more of those that go on (1) after all have been judged.
template <typename Walker, typename Walk>
std::vector<SettledSeed> walk_to_rest(VisibilitySource& source, std::span<const Seed> seeds,
                                      Walk walk, const SettleProgress& progress) {
    std::vector<SettledSeed> settled(seeds.size());
    std::vector<Walker> walkers(seeds.size());
    for (std::uint32_t i = 0; i < seeds.size(); ++i) {
        settled[i].position = walkers[i].tried = seeds[i].position;
        walkers[i].index = i;
    }
    const auto all = static_cast<double>(seeds.size());
    std::vector<Vec3> eyes;
    std::vector<EyeRecord> records;
    std::vector<std::uint8_t> goes_on;
    while (!walkers.empty()) {
        eyes.clear();
        for (const Walker& walker : walkers) eyes.push_back(walker.tried);
        records.resize(eyes.size());
        source.look(eyes, records);
        goes_on.resize(eyes.size());
        parallel_for(walkers.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                SettledSeed& seed = settled[walkers[i].index];
                ++seed.evaluations;
                goes_on[i] = walk.advance(walkers[i], seed, records[i]) ? 1 : 0;
            }
        });
        walk.end_round(walkers, settled, goes_on);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            if (goes_on[i] != 0) walkers[kept++] = walkers[i];
        }
        walkers.resize(kept);
        if (progress) progress(1.0 - static_cast<double>(kept) / all);
    }
    return settled;
}

}  // namespace zskel
