#pragma once

#include "model.h"

#include <string>
#include <vector>

namespace zskel::models {

/// Measures a model against what it is expected to be: closed but for the stated boundary loops,
/// manifold, oriented outward, in one piece, of the stated genus and size, with a true skeleton
/// that lies inside and, along tubes, as far from the surface as it says.
struct CheckResult {
    std::string measured;               ///< One line of numbers.
    std::vector<std::string> failures;  ///< What is wrong, a sentence each; empty when all is well.
};
CheckResult check_model(const Model& model);

}  // namespace zskel::models
