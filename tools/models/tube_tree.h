#pragma once

#include "model.h"

#include <cstddef>
#include <string>
#include <vector>

namespace zskel::models {

/// A curved piece of a tube tree between two of its joints or ends.
struct Tube {
    static constexpr std::size_t kNoParent = static_cast<std::size_t>(-1);
    std::size_t parent = kNoParent;
    std::vector<std::size_t> children;  ///< None, or two.
    glm::dvec3 start, end;
    glm::dvec3 start_direction, end_direction;  ///< Unit vectors along the tube.
    double radius = 0.0;

    /// Point at `t` in [0, 1] on the tube's axis.
    glm::dvec3 at(double t) const;
};

/// Radius of the sphere around the end of `tube` on which its rim and its children's lie apart.
double joint_radius(const std::vector<Tube>& tubes, const Tube& tube);

/// Sweeps rings along the tubes and closes each joint by the convex hull of its three rims: closed,
/// manifold, of genus 0, whatever the tree. The `open_ends` widest ends, the root (the first tube)
/// before all, are cut flat.
Model sweep_tubes(const std::string& name, const std::vector<Tube>& tubes, std::size_t open_ends);

}  // namespace zskel::models
