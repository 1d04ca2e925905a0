#pragma once

#include <functional>
#include <string>
#include <vector>

#include "zskel/mesh/mesh.h"

namespace zskel {

/// A piece of a surface given by a formula, over u and v from 0 to 1. The normal is that of
/// dS/du x dS/dv.
struct ParametricPatch {
    std::function<DVec3(double u, double v)> at;
};

/// Pieces that share their edges, and are divided alike so that these stay shared.
using PatchGroup = std::vector<ParametricPatch>;

/// Bernstein polynomials of any degree. @param points  rows over v of columns over u.
ParametricPatch bezier_patch(std::vector<std::vector<DVec3>> points);

/// A rational B-spline surface, a patch for each pair of spans that are not empty.
struct Nurbs {
    int degree_u = 3;
    int degree_v = 3;
    std::vector<double> knots_u;  ///< ascending; columns + degree_u + 1
    std::vector<double> knots_v;  ///< ascending; rows + degree_v + 1
    std::vector<std::vector<glm::dvec4>>
        points;  ///< rows over v of columns over u: x, y, z, weight
};
PatchGroup nurbs_patches(const Nurbs& nurbs);

/// |z / c|^(2 / e1) + (|x / a|^(2 / e2) + |y / b|^(2 / e2))^(e2 / e1) = 1, in eight patches.
/// @see Barr 1981 (superquadrics and angle-preserving transformations); here the angles are those
/// of the points themselves, which spreads them more evenly.
struct Superquadric {
    DVec3 radii{1.0};         ///< a, b, c
    double exponent_1 = 1.0;  ///< north to south: 1 round, towards 0 square
    double exponent_2 = 1.0;  ///< east to west
    DVec3 center{0.0};
    DVec3 axis{0.0, 0.0, 1.0};  ///< turned about it
    double turn = 0.0;          ///< radians
};
PatchGroup superquadric_patches(const Superquadric& superquadric);

/// Triangles no farther from a surface than a bound, as its middles between grid points tell. Each
/// group gets the coarsest even grid that does; vertices that fall together within 1e-9 of the
/// diagonal become one, and what has no area then is left out.
/// @param chord_error  in diagonals of the bounding box, above 0.
/// @param name         stands in messages.
/// @param max_faces    triangles; 0: as many as can be numbered.
/// @throws LimitError for more than `max_faces`. InputError when a group asks for more than 512
/// steps along a patch, or 16 million triangles, or a place is not finite.
Mesh tessellate(const std::vector<PatchGroup>& groups, double chord_error, const std::string& name,
                std::size_t max_faces = 0);

}  // namespace zskel
