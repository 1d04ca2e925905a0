#pragma once

#include "shape.h"

namespace zskel::models {

/// A standing horse: rump, back and chest, four legs with hooves, neck, head, ears and tail.
Shape shape_horse();

}  // namespace zskel::models
