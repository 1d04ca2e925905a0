#pragma once

#include "model.h"

namespace zskel::models {

/// The unit cube, each side a grid of `cells` by `cells` squares cut in two.
Model make_cube(const std::string& name, unsigned cells);

/// A sphere of diameter 1: a cube's grid drawn onto it.
Model make_sphere();

Model make_capsule();
Model make_torus();

/// Three round arms of different lengths that meet in the middle.
Model make_y();

/// Two rings that share a wall.
Model make_double_torus();

}  // namespace zskel::models
