#pragma once

#include "model.h"

#include <functional>
#include <string>
#include <vector>

namespace zskel::models {

/// A model that the program can make.
struct Recipe {
    std::string name;
    std::function<Model()> make;
};

/// All of them, in the order of models/README.md.
const std::vector<Recipe>& catalogue();

}  // namespace zskel::models
