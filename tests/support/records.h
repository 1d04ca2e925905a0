#pragma once

#include <algorithm>
#include <cmath>

#include "zskel/visibility/visibility_source.h"

namespace zskel::test {

inline EyeRecord look(VisibilitySource& source, const Vec3& eye) {
    EyeRecord record;
    source.look(std::span(&eye, 1), std::span(&record, 1));
    return record;
}

inline double relative(double a, double b, double scale) {
    return std::abs(a - b) / scale;
}

// Every entry of two records of one eye, in units of the force's own scale.
inline double difference(const EyeRecord& a, const EyeRecord& b) {
    const double scale = 1.0 / std::min(a.nearest, b.nearest);
    double worst = std::max<double>(relative(a.nearest, b.nearest, b.nearest),
                                    relative(a.clearance, b.clearance, b.clearance));
    worst = std::max<double>({worst, std::abs(a.back_fraction - b.back_fraction),
                              std::abs(a.hit_fraction - b.hit_fraction)});
    for (int k = 0; k < 3; ++k) worst = std::max(worst, relative(a.force[k], b.force[k], scale));
    for (std::size_t k = 0; k < 6; ++k)
        worst = std::max(worst, relative(a.jacobian[k], b.jacobian[k], scale * scale));
    return worst;
}

}  // namespace zskel::test
