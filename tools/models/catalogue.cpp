#include "catalogue.h"

#include "creatures.h"
#include "plant.h"
#include "primitives.h"
#include "quadrupeds.h"
#include "teapot.h"
#include "vessels.h"

namespace zskel::models {
namespace {

Recipe recipe(const std::string& name, Shape (*shape)(), const Expected& expected, int levels = 7) {
    return {name, [=] { return mesh_shape(name, shape(), expected, levels); }};
}

}  // namespace

const std::vector<Recipe>& catalogue() {
    static const std::vector<Recipe> recipes = {
        recipe("mouse", shape_mouse, {.faces = 2000, .ends = 8}),
        recipe("bull", shape_bull, {.faces = 2000, .ends = 10}),
        recipe("octopus", shape_octopus, {.faces = 2100, .ends = 9}),
        recipe("cobra", shape_cobra, {.faces = 2000, .ends = 2}),
        recipe("frog", shape_frog, {.faces = 2000, .ends = 13}),
        recipe("hand", shape_hand, {.faces = 2000, .ends = 6}),
        recipe("horse", shape_horse, {.faces = 2000, .ends = 8}),
        recipe("horse_8k", shape_horse, {.faces = 8000, .ends = 8}, 8),
        recipe("plant", shape_plant, {.faces = 32000, .ends = 15}, 8),
        {"vessels", [] { return make_vessels("vessels", 0); }},
        {"vessels_open", [] { return make_vessels("vessels_open", 4); }},
        {"teapot", make_teapot},
        {"capsule", make_capsule},
        {"y", make_y},
        {"torus", make_torus},
        {"double_torus", make_double_torus},
        {"cube", [] { return make_cube("cube", 10); }},
        {"cube_coarse", [] { return make_cube("cube_coarse", 1); }},
        {"sphere", make_sphere},
    };
    return recipes;
}

}  // namespace zskel::models
