#pragma once

#include "field.h"
#include "triangles.h"

namespace zskel::models {

/// The zero surface of a field inside the cube [-0.52, 0.52]^3, sampled with 2^levels cells a side:
/// closed, manifold and oriented outward, whatever the field's values are.
Triangles extract_surface(const Field& field, int levels);

}  // namespace zskel::models
