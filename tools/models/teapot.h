#pragma once

#include "model.h"

namespace zskel::models {

/// A pot with a spout, a handle and a knob on its lid, of bicubic patches: unit cubes put together,
/// their boundary made smooth.
Model make_teapot();

}  // namespace zskel::models
