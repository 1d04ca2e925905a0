#pragma once

#include "shape.h"

#include <glm/glm.hpp>

#include <vector>

namespace zskel::models {

/// Signed distance to a shape's surface, negative inside; never steeper than about 1.
class Field {
  public:
    explicit Field(const Shape& shape);

    double distance(const glm::dvec3& p) const { return sample(p).distance; }

    /// Radius of the limb whose surface is nearest, mixed across fillets.
    double radius(const glm::dvec3& p) const { return sample(p).radius; }

    /// The nearest point at distance `level`, by a few Newton steps along the gradient.
    glm::dvec3 project(glm::dvec3 p, double level) const;

    /// Unit direction in which the distance grows fastest.
    glm::dvec3 normal(const glm::dvec3& p) const;

  private:
    struct Sample {
        double distance, radius;
    };
    struct Part {
        Limb limb;
        glm::dvec3 box_low, box_high;
        double reach;
    };
    Sample sample(const glm::dvec3& p) const;
    glm::dvec3 gradient(const glm::dvec3& p) const;

    std::vector<Part> parts_;
};

}  // namespace zskel::models
