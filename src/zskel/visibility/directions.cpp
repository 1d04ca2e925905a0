#include "zskel/visibility/directions.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "zskel/core/error.h"

namespace zskel {

Directions radial_directions(int count) {
    if (count < 4 || count > 1'000'000) {
        throw UsageError(fmt::format("{} rays an eye: give 4 to 1000000", count));
    }
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    Directions out;
    out.unit.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double ring = std::sqrt(1.0 - z * z);
        out.unit.emplace_back(ring * std::cos(golden_angle * i), ring * std::sin(golden_angle * i),
                              z);
    }
    out.weight.assign(out.unit.size(), 1.0 / count);
    return out;
}

}  // namespace zskel
