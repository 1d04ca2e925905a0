#pragma once

#include "triangles.h"

#include <array>
#include <vector>

namespace zskel::models {

/// Four rows of four control points; rows run along v, and dS/du x dS/dv points outward.
using BezierPatch = std::array<std::array<glm::dvec3, 4>, 4>;

/// Quadrilaterals with shared vertices; they turn counter-clockwise seen from outside.
struct Quads {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec4> faces;
};

/// The boundary of a set of unit cubes, each given by its lowest corner.
Quads cube_boundary(const std::vector<glm::ivec3>& cubes);

/// A smooth closed surface with a bicubic patch a quadrilateral: that of uniform B-splines where
/// four meet, close to the limit of Catmull and Clark's subdivision elsewhere. No gaps.
/// @see Loop and Schaefer 2008 (approximating Catmull-Clark subdivision surfaces with bicubic
/// patches), the geometry patches
std::vector<BezierPatch> smooth_patches(const Quads& quads);

/// Every patch as a grid of `steps` by `steps` squares cut in two; equal corners are one.
Triangles triangulate(const std::vector<BezierPatch>& patches, int steps);

}  // namespace zskel::models
