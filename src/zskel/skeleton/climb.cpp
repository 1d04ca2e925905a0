#include "zskel/skeleton/climb.h"

#include <array>

namespace zskel {
namespace {

// In radii of where the climb begins; so every step stays in the inscribed ball.
constexpr float kFirstStep = 0.25f;
constexpr float kLastStep = 0.03125f;
constexpr float kLeastGain = 1.001f;  // less is rounding: a plate is as thick wherever one stands

// To the faces and the corners of a cube.
std::array<Vec3, 14> directions_round() {
    std::array<Vec3, 14> out;
    for (int i = 0; i < 3; ++i) {
        Vec3 axis(0.0f);
        axis[i] = 1.0f;
        out[2 * i] = axis;
        out[2 * i + 1] = -axis;
    }
    for (int i = 0; i < 8; ++i)
        out[6 + i] = glm::normalize(Vec3((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1));
    return out;
}

}  // namespace

Climb climb_to_thickest(const Vec3& from, double reach, const SurfaceQuery& query) {
    static const std::array<Vec3, 14> directions = directions_round();
    const float radius = query.nearest(from).distance;
    const float farthest = static_cast<float>(reach) * radius;
    Vec3 best = from;
    float most = radius;
    float step = kFirstStep * radius;
    while (step >= kLastStep * radius && step > 0.0f) {
        const Vec3 here = best;
        float bound = kLeastGain * most;
        for (const Vec3& direction : directions) {
            const Vec3 there = here + direction * step;
            if (glm::distance(there, from) > farthest) continue;
            const float thickness = query.nearest(there, most + step).distance;
            if (thickness <= bound) continue;
            best = there;
            most = bound = thickness;
        }
        if (best == here) step *= 0.5f;
    }
    if (best == from) return {from, 0.0f};
    return {best, (most - radius) / glm::distance(best, from)};
}

}  // namespace zskel
