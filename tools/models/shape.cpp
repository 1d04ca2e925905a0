// Limbs run along centripetal Catmull-Rom curves (Barry and Goldman 1988; Yuksel et al. 2011): they
// pass through every control ball without loops; the radius is a fourth coordinate of the curve.
#include "shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zskel::models {
namespace {

Ball blend_between(const Ball& a, const Ball& b, double ta, double tb, double t) {
    return ((tb - t) * a + (t - ta) * b) / (tb - ta);
}

/// Point at `u` in [0, 1] between q[1] and q[2] on the curve through four balls.
Ball evaluate_span(const Ball (&q)[4], double u) {
    double t[4] = {0.0};
    for (int i = 1; i < 4; ++i) {
        t[i] = t[i - 1] + std::sqrt(glm::distance(q[i - 1], q[i]));
    }
    const double at = t[1] + u * (t[2] - t[1]);
    const Ball a = blend_between(q[0], q[1], t[0], t[1], at);
    const Ball b = blend_between(q[1], q[2], t[1], t[2], at);
    const Ball c = blend_between(q[2], q[3], t[2], t[3], at);
    const Ball ab = blend_between(a, b, t[0], t[2], at);
    const Ball bc = blend_between(b, c, t[1], t[3], at);
    return blend_between(ab, bc, t[1], t[2], at);
}

std::vector<Ball> sample_curve(const std::vector<Ball>& control, bool is_loop) {
    const std::size_t count = control.size();
    const std::size_t spans = is_loop ? count : count - 1;
    const auto ball_at = [&](std::ptrdiff_t i) -> Ball {
        const auto n = static_cast<std::ptrdiff_t>(count);
        if (is_loop) {
            return control[static_cast<std::size_t>((i + n) % n)];
        }
        if (i < 0) {
            return 2.0 * control[0] - control[1];
        }
        return i < n ? control[static_cast<std::size_t>(i)]
                     : 2.0 * control[count - 1] - control[count - 2];
    };
    std::vector<Ball> balls;
    for (std::size_t s = 0; s < spans; ++s) {
        const auto i = static_cast<std::ptrdiff_t>(s);
        const Ball q[4] = {ball_at(i - 1), ball_at(i), ball_at(i + 1), ball_at(i + 2)};
        const double length = glm::distance(glm::dvec3(q[1]), glm::dvec3(q[2]));
        const double steps =
            std::clamp(std::ceil(length / (0.6 * std::min(q[1].w, q[2].w))), 1.0, 12.0);
        for (double k = 0.0; k < steps; k += 1.0) {
            Ball ball = evaluate_span(q, k / steps);
            ball.w =
                std::clamp(ball.w, 0.9 * std::min(q[1].w, q[2].w), 1.1 * std::max(q[1].w, q[2].w));
            balls.push_back(ball);
        }
    }
    if (!is_loop) {
        balls.push_back(control.back());
    }
    return balls;
}

/// Where a ball of a squeezed limb ends up in the model.
glm::dvec3 squeezed_position(const Limb& limb, const Ball& ball) {
    const Squeeze& squeeze = limb.options.squeeze;
    const glm::dvec3 offset = glm::dvec3(ball) - glm::dvec3(limb.balls.front());
    return glm::dvec3(ball) +
           (squeeze.factor - 1.0) * glm::dot(offset, squeeze.axis) * squeeze.axis;
}

Ball mirrored(const Ball& ball) {
    return {ball.x, ball.y, -ball.z, ball.w};
}

}  // namespace

std::size_t Shape::find_joint(const Ball& first, const std::string& from) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t joint = 0;
    for (const TruthLimb& limb : truth_.limbs) {
        if (!from.empty() && limb.name != from) {
            continue;
        }
        for (const std::size_t node : limb.nodes) {
            const double away = glm::distance(truth_.nodes[node].position, glm::dvec3(first));
            if (away >= least) {
                continue;
            }
            least = away;
            joint = node;
            for (const std::size_t end : {limb.nodes.front(), limb.nodes.back()}) {
                const Truth::Node& ball = truth_.nodes[end];
                if (glm::distance(ball.position, glm::dvec3(first)) < 0.9 * ball.radius) {
                    joint = end;
                }
            }
        }
    }
    return joint;
}

void Shape::grow(const std::string& name, const std::vector<Ball>& control,
                 const LimbOptions& options) {
    const Limb& limb =
        limbs_.emplace_back(Limb{name, sample_curve(control, options.is_loop), options});
    if (options.is_flesh) {
        return;
    }
    TruthLimb part{name, {}, options.is_tube};
    if (!truth_.nodes.empty()) {
        part.nodes.push_back(find_joint(limb.balls.front(), options.from));
    }
    for (const Ball& ball : limb.balls) {
        const glm::dvec3 position = squeezed_position(limb, ball);
        const std::size_t node = truth_.nodes.size();
        if (!part.nodes.empty()) {
            if (truth_.nodes[part.nodes.back()].position == position) {
                continue;
            }
            truth_.edges.emplace_back(part.nodes.back(), node);
        }
        part.nodes.push_back(node);
        truth_.nodes.push_back({position, ball.w * options.squeeze.factor});
    }
    if (options.is_loop) {
        truth_.edges.emplace_back(part.nodes.back(),
                                  part.nodes[part.nodes.size() - limb.balls.size()]);
    }
    truth_.limbs.push_back(std::move(part));
}

void Shape::grow_pair(const std::string& name, const std::vector<Ball>& control,
                      const LimbOptions& options) {
    std::vector<Ball> left(control.size());
    std::transform(control.begin(), control.end(), left.begin(), mirrored);
    LimbOptions left_options = options;
    left_options.squeeze.axis.z *= -1.0;
    grow("right " + name, control, options);
    grow("left " + name, left, left_options);
}

void Shape::fit_unit_cube() {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const Limb& limb : limbs_) {
        const Squeeze& squeeze = limb.options.squeeze;
        const glm::dvec3 extent = 1.0 - (1.0 - squeeze.factor) * squeeze.axis * squeeze.axis;
        for (const Ball& ball : limb.balls) {
            const glm::dvec3 centre = squeezed_position(limb, ball);
            low = glm::min(low, centre - ball.w * extent);
            high = glm::max(high, centre + ball.w * extent);
        }
    }
    const glm::dvec3 size = high - low;
    const double scale = 1.0 / std::max({size.x, size.y, size.z});
    const glm::dvec3 centre = 0.5 * (low + high);
    for (Limb& limb : limbs_) {
        for (Ball& ball : limb.balls) {
            ball = scale * (ball - Ball(centre, 0.0));
        }
        limb.options.blend *= scale;
        limb.options.reach *= scale;
    }
    for (Truth::Node& node : truth_.nodes) {
        node = {scale * (node.position - centre), scale * node.radius};
    }
}

}  // namespace zskel::models
