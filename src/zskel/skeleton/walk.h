#pragma once

#include <vector>

#include "zskel/skeleton/settle.h"

namespace zskel {

/// An eye inside a solid sees its surface from behind: with a smaller share of back faces it has
/// left.
inline constexpr float kLeastBackFraction = 0.5f;

/// Lets all walkers look together, one batch a round, until each is at rest.
/// @param walkers  each with the point `tried` that it waits to look from; empty afterwards.
/// @param advance  bool(Walker&, const EyeRecord&): judges what was met at `tried`; true when it
/// goes on.
template <typename Walker, typename Advance>
void walk_to_rest(VisibilitySource& source, std::vector<Walker>& walkers, Advance advance,
                  const SettleProgress& progress) {
    const auto all = static_cast<double>(walkers.size());
    std::vector<Vec3> eyes;
    std::vector<EyeRecord> records;
    while (!walkers.empty()) {
        eyes.clear();
        for (const Walker& walker : walkers) eyes.push_back(walker.tried);
        records.resize(eyes.size());
        source.look(eyes, records);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            if (advance(walkers[i], records[i])) walkers[kept++] = walkers[i];
        }
        walkers.resize(kept);
        if (progress) progress(1.0 - static_cast<double>(kept) / all);
    }
}

}  // namespace zskel
