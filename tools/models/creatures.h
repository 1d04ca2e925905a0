#pragma once

#include "shape.h"

namespace zskel::models {

/// A bag of a body over eight curling arms.
Shape shape_octopus();

/// A snake: a winding body that rises to a flat hood and a head.
Shape shape_cobra();

/// A sitting frog: folded hind legs, three toes on every foot.
Shape shape_frog();

/// A right hand with its forearm and five spread fingers.
Shape shape_hand();

}  // namespace zskel::models
