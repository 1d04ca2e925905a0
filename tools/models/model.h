#pragma once

#include "patches.h"
#include "shape.h"
#include "triangles.h"
#include "truth.h"

#include <cstddef>
#include <string>
#include <vector>

namespace zskel::models {

/// What a finished model must be; `zskel_make_models --check` measures it.
struct Expected {
    std::size_t faces = 0;  ///< Within 5 %.
    std::size_t genus = 0;
    std::size_t boundary_loops = 0;
    std::size_t ends = 0;           ///< Of the true skeleton.
    std::size_t cycles = 0;         ///< Of the true skeleton.
    double radius_tolerance = 0.3;  ///< Of a tube's radius against its distance to the mesh.
};

/// A mesh and the skeleton that it was built from, both in the unit cube around the origin.
struct Model {
    std::string name;
    Triangles mesh;
    Truth truth;
    Expected expected;
    std::vector<BezierPatch> patches =
        {};  ///< That the mesh was made from, which is then not kept.
};

/// Scales the shape to the unit cube, and meshes it with about `expected.faces` triangles.
Model mesh_shape(const std::string& name, Shape shape, const Expected& expected, int levels = 7);

}  // namespace zskel::models
