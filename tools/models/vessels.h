#pragma once

#include "model.h"

#include <cstddef>
#include <string>

namespace zskel::models {

/// A tree of vessels, each dividing in two, radii from 0.02 down to 0.002, no two touching; the
/// `open_ends` widest ends are cut open, the inlet first.
Model make_vessels(const std::string& name, std::size_t open_ends);

}  // namespace zskel::models
