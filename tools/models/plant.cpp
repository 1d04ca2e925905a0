// Leaves follow each other around the stem by the golden angle.
#include "plant.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace zskel::models {
namespace {

constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);

glm::dvec3 outward(double around, double rise) {
    return glm::normalize(glm::dvec3(std::cos(around), rise, std::sin(around)));
}

/// A stalk from `root` and a flat leaf at its end.
void grow_leaf(Shape& plant, const std::string& name, const std::string& from,
               const glm::dvec3& root, double around, double size) {
    const glm::dvec3 up = outward(around, 1.1), out = outward(around, 0.35);
    const glm::dvec3 base = root + 0.45 * size * up;
    plant.grow("stalk of " + name, {{root, 0.018}, {root + 0.25 * size * up, 0.016}, {base, 0.016}},
               {.blend = 0.010, .from = from});
    const glm::dvec3 side = glm::normalize(glm::cross(out, glm::dvec3(0, 1, 0)));
    plant.grow(name,
               {{base, 0.035},
                {base + 0.35 * size * out, 0.30 * size},
                {base + 0.60 * size * out, 0.26 * size},
                {base + 1.15 * size * out, 0.055}},
               {.blend = 0.015,
                .squeeze = {.axis = glm::cross(side, out), .factor = 0.36},
                .is_tube = false,
                .from = "stalk of " + name});
}

}  // namespace

Shape shape_plant() {
    Shape plant;
    plant.grow("stem", {{0.00, 0.00, 0.00, 0.036},
                        {0.02, 0.40, 0.01, 0.032},
                        {-0.02, 0.80, 0.00, 0.027},
                        {0.01, 1.20, -0.02, 0.022},
                        {0.00, 1.55, 0.00, 0.018}});
    for (int shoot = 0; shoot < 3; ++shoot) {
        const double around = 0.4 + shoot * 2.0 * std::numbers::pi / 3.0;
        const glm::dvec3 root(0.0, 0.42 + 0.13 * shoot, 0.0);
        const glm::dvec3 bend = root + 0.30 * outward(around, 0.7);
        const glm::dvec3 tip = bend + (0.42 - 0.05 * shoot) * outward(around, 2.0);
        const std::string name = fmt::format("shoot {}", shoot + 1);
        plant.grow(name, {{root, 0.022}, {bend, 0.020}, {tip, 0.016}},
                   {.blend = 0.03, .from = "stem"});
        for (int leaf = 0; leaf < 3; ++leaf) {
            const glm::dvec3 at = leaf < 2 ? glm::mix(bend, tip, 0.25 + 0.4 * leaf) : tip;
            grow_leaf(plant, fmt::format("leaf {} of {}", leaf + 1, name), name, at,
                      around + (leaf < 2 ? (leaf == 0 ? 1.3 : -1.3) : 0.0), 0.34);
        }
    }
    for (int leaf = 0; leaf < 5; ++leaf) {
        const double height = leaf < 4 ? 1.05 + 0.13 * leaf : 1.55;
        grow_leaf(plant, fmt::format("leaf {}", leaf + 1), "stem", {0.0, height, 0.0},
                  1.5 + leaf * kGoldenAngle, 0.44 - 0.02 * leaf);
    }
    return plant;
}

}  // namespace zskel::models
