#pragma once

#include "shape.h"

namespace zskel::models {

/// A plant: a stem with side shoots, and leaves around them on thin stalks.
Shape shape_plant();

}  // namespace zskel::models
