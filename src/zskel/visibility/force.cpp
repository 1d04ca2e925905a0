#include "zskel/visibility/force.h"

#include <algorithm>
#include <cmath>

namespace zskel {
namespace {

// An eye on the surface meets it at distance 0; its force is then huge, but finite.
constexpr double kLeastDistance = 1e-12;

// Least distance, measured along the force, to anything within the cone about it.
float clearance_ahead(const Directions& directions, const MapView& map, const DVec3& force) {
    const double strength = glm::length(force);
    if (!(strength > 0.0)) return kInfinity;
    double least = kInfinity;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double cosine = glm::dot(directions.unit[i], force) / strength;
        if (cosine >= kAheadCosine)
            least = std::min(least, static_cast<double>(map.distance[i]) * cosine);
    }
    return static_cast<float>(least);
}

}  // namespace

Force force_at(const Directions& directions, const MapView& map) {
    Force out;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (!std::isfinite(map.distance[i])) continue;
        const double share =
            directions.weight[i] / std::max<double>(map.distance[i], kLeastDistance);
        out.vector -= share * directions.unit[i];
        out.mean_inverse_distance += share;
        out.hit_fraction += directions.weight[i];
    }
    return out;
}

EyeRecord summarize(const Directions& directions, const MapView& map, const Surface& surface) {
    const Force force = force_at(directions, map);
    EyeRecord out;
    out.force = Vec3(force.vector);
    out.hit_fraction = static_cast<float>(force.hit_fraction);
    out.clearance = clearance_ahead(directions, map, force.vector);
    double back = 0.0;
    std::array<double, 6> jacobian{};
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (!std::isfinite(map.distance[i])) continue;
        const DVec3& d = directions.unit[i];
        const double r = std::max<double>(map.distance[i], kLeastDistance);
        out.nearest = std::min(out.nearest, map.distance[i]);
        DVec3 n(surface.triangle_normals[map.id[i]]);
        double facing = glm::dot(n, d);
        if (facing > 0.0) back += directions.weight[i];
        if (facing < 0.0) n = -n;
        facing = std::max(std::abs(facing), double{kGrazingCosine});
        const DVec3 g = n * (directions.weight[i] / (r * r * facing));
        jacobian[0] += d.x * g.x;
        jacobian[1] += d.y * g.y;
        jacobian[2] += d.z * g.z;
        jacobian[3] += 0.5 * (d.x * g.y + d.y * g.x);
        jacobian[4] += 0.5 * (d.x * g.z + d.z * g.x);
        jacobian[5] += 0.5 * (d.y * g.z + d.z * g.y);
    }
    std::transform(jacobian.begin(), jacobian.end(), out.jacobian.begin(),
                   [](double value) { return static_cast<float>(value); });
    if (force.hit_fraction > 0.0) out.back_fraction = static_cast<float>(back / force.hit_fraction);
    return out;
}

}  // namespace zskel
