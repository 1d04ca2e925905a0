// Limbs join by the polynomial smooth minimum (after Quilez). Its width fades with the distance
// from the limb's first ball, so a leg has a fillet at the hip and yet never welds to the leg
// beside it.
#include "field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zskel::models {
namespace {

constexpr double kGradientStep = 1e-5;
constexpr double kOnSurface = 1e-7;

struct Nearest {
    double distance, radius;
};

Nearest nearest_of(const Nearest& a, const Nearest& b) {
    return b.distance < a.distance ? b : a;
}

Nearest distance_to_ball(const glm::dvec3& p, const Ball& ball) {
    return {glm::distance(p, glm::dvec3(ball)) - ball.w, ball.w};
}

/// Distance to the hull of two balls: the least of |p - c(t)| - r(t) over the axis, which is convex
/// in t, so the free minimum only needs to be clamped.
Nearest distance_to_cone(const glm::dvec3& p, const Ball& a, const Ball& b) {
    const glm::dvec3 axis = glm::dvec3(b) - glm::dvec3(a);
    const double length = glm::length(axis);
    const double slope = (a.w - b.w) / length;
    if (!(std::abs(slope) < 1.0)) {
        return nearest_of(distance_to_ball(p, a), distance_to_ball(p, b));
    }
    const glm::dvec3 from_a = p - glm::dvec3(a);
    const double along = glm::dot(from_a, axis) / length;
    const double across = std::sqrt(std::max(0.0, glm::dot(from_a, from_a) - along * along));
    const double foot = along - across * slope / std::sqrt(1.0 - slope * slope);
    const double t = std::clamp(foot, 0.0, length);
    const double radius = a.w - slope * t;
    return {std::sqrt((along - t) * (along - t) + across * across) - radius, radius};
}

Nearest distance_to_limb(const glm::dvec3& p, const Limb& limb) {
    const Squeeze& squeeze = limb.options.squeeze;
    const std::vector<Ball>& balls = limb.balls;
    const double offset = glm::dot(p - glm::dvec3(balls.front()), squeeze.axis);
    const glm::dvec3 q = p + (1.0 / squeeze.factor - 1.0) * offset * squeeze.axis;
    Nearest nearest = distance_to_ball(q, balls.front());
    for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
        nearest = nearest_of(nearest, distance_to_cone(q, balls[i], balls[i + 1]));
    }
    if (limb.options.is_loop) {
        nearest = nearest_of(nearest, distance_to_cone(q, balls.back(), balls.front()));
    }
    return {squeeze.factor * nearest.distance, squeeze.factor * nearest.radius};
}

/// The smooth minimum of both, `width` wide.
Nearest join(const Nearest& a, const Nearest& b, double width) {
    const Nearest nearest = nearest_of(a, b);
    const double apart = std::abs(a.distance - b.distance);
    if (!(apart < width)) {
        return nearest;
    }
    const double share = 0.5 * (1.0 - apart / width);  // of the farther one
    const double farther_radius = b.distance < a.distance ? a.radius : b.radius;
    return {nearest.distance - width * share * share,
            glm::mix(nearest.radius, farther_radius, share)};
}

double distance_to_box(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
    return glm::length(glm::max(glm::max(low - p, p - high), glm::dvec3(0.0)));
}

}  // namespace

Field::Field(const Shape& shape) {
    for (const Limb& limb : shape.limbs()) {
        Part part{limb, glm::dvec3(std::numeric_limits<double>::infinity()),
                  glm::dvec3(-std::numeric_limits<double>::infinity()), limb.options.reach};
        for (const Ball& ball : limb.balls) {
            part.box_low = glm::min(part.box_low, glm::dvec3(ball) - ball.w);
            part.box_high = glm::max(part.box_high, glm::dvec3(ball) + ball.w);
        }
        if (part.reach == 0.0) {
            part.reach = 2.0 * limb.balls.front().w + 2.0 * limb.options.blend;
        }
        parts_.push_back(std::move(part));
    }
}

Field::Sample Field::sample(const glm::dvec3& p) const {
    Nearest nearest{std::numeric_limits<double>::infinity(), 0.0};
    for (const Part& part : parts_) {
        const LimbOptions& options = part.limb.options;
        const double box = distance_to_box(p, part.box_low, part.box_high);
        if (options.squeeze.factor * box > nearest.distance + options.blend) {
            continue;
        }
        const double away = glm::distance(p, glm::dvec3(part.limb.balls.front())) / part.reach;
        const double fade = std::max(0.0, 1.0 - away * away);
        nearest = join(nearest, distance_to_limb(p, part.limb), options.blend * fade * fade);
    }
    return {nearest.distance, nearest.radius};
}

glm::dvec3 Field::gradient(const glm::dvec3& p) const {
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 step(0.0);
        step[i] = kGradientStep;
        result[i] = (distance(p + step) - distance(p - step)) / (2.0 * kGradientStep);
    }
    return result;
}

glm::dvec3 Field::normal(const glm::dvec3& p) const {
    const glm::dvec3 g = gradient(p);
    const double length = glm::length(g);
    return length > 0.0 ? g / length : glm::dvec3(0.0, 1.0, 0.0);
}

glm::dvec3 Field::project(glm::dvec3 p, double level) const {
    for (int i = 0; i < 5; ++i) {
        const double d = distance(p) - level;
        if (std::abs(d) < kOnSurface) {
            break;
        }
        const glm::dvec3 g = gradient(p);
        const double steepness = std::max(glm::dot(g, g), 0.25);
        p -= d / steepness * g;
    }
    return p;
}

}  // namespace zskel::models
