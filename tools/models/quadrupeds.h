#pragma once

#include "shape.h"

namespace zskel::models {

/// A standing horse: rump, back and chest, four legs with hooves, neck, head, ears and tail.
Shape shape_horse();

/// A heavy bull: low head, horns and ears to the sides, a tail with a tuft.
Shape shape_bull();

/// A mouse on its feet: round ears, pointed snout, long tail.
Shape shape_mouse();

}  // namespace zskel::models
