#include "zskel/mesh/winding.h"

#include <cmath>
#include <numbers>

namespace zskel {

double winding_number(const std::vector<Vec3>& positions, std::span<const Triangle> triangles,
                      const DVec3& point) {
    double half_angles = 0.0;
    for (const Triangle& t : triangles) {
        const DVec3 a = DVec3(positions[t.x]) - point;
        const DVec3 b = DVec3(positions[t.y]) - point;
        const DVec3 c = DVec3(positions[t.z]) - point;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        const double volume = glm::dot(a, glm::cross(b, c));
        const double denominator =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        half_angles += std::atan2(volume, denominator);
    }
    return half_angles / (2.0 * std::numbers::pi);
}

}  // namespace zskel
