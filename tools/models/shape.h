#pragma once

#include "truth.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace zskel::models {

/// One ball of a limb: x, y, z, radius.
using Ball = glm::dvec4;

/// Flattens a limb's cross section: along `axis` through the limb's first ball everything is
/// scaled by `factor`, at most 1.
struct Squeeze {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double factor = 1.0;
};

/// How a limb is built; lengths are in the shape's own units.
struct LimbOptions {
    double blend = 0.05;  ///< Widest fillet where the limb leaves what was built before it.
    double reach = 0.0;   ///< How far from its first ball it blends; 0 picks it from the radius.
    Squeeze squeeze = {};
    bool is_tube = true;    ///< Its radii are the distances to the surface.
    bool is_flesh = false;  ///< Shapes the surface only; the truth does not know it.
    bool is_loop = false;   ///< Its last ball joins its first.
    std::string from = {};  ///< The limb that its skeleton hangs on; empty for any.
};

/// A chain of balls, dense along a smooth curve; the surface is the hull of each ball and the next.
struct Limb {
    std::string name;
    std::vector<Ball> balls;
    LimbOptions options;
};

/// A body of limbs, and the skeleton that they follow. The frame: x forward, y up, z to the right.
class Shape {
  public:
    /// Adds a smooth limb through the balls of `control`. Its skeleton starts at the node of the
    /// skeleton so far that is nearest to the first ball, the end of a limb before its middle.
    void grow(const std::string& name, const std::vector<Ball>& control,
              const LimbOptions& options = {});

    /// Adds "right NAME" as given and "left NAME" mirrored at z = 0.
    void grow_pair(const std::string& name, const std::vector<Ball>& control,
                   const LimbOptions& options = {});

    /// Moves the shape's bounding box to the origin and scales its longest side to 1.
    void fit_unit_cube();

    const std::vector<Limb>& limbs() const { return limbs_; }
    const Truth& truth() const { return truth_; }

  private:
    std::size_t find_joint(const Ball& first, const std::string& from) const;

    std::vector<Limb> limbs_;
    Truth truth_;
};

}  // namespace zskel::models
