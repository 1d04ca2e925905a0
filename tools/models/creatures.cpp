#include "creatures.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace zskel::models {

Shape shape_octopus() {
    Shape octopus;
    octopus.grow("body",
                 {{0.00, 0.20, 0, 0.17},
                  {-0.02, 0.38, 0, 0.17},
                  {-0.10, 0.60, 0, 0.235},
                  {-0.22, 0.82, 0, 0.23},
                  {-0.30, 0.95, 0, 0.16}},
                 {.is_tube = false});
    octopus.grow_pair("eye", {{0.10, 0.40, 0.13, 0.06}, {0.11, 0.41, 0.14, 0.06}},
                      {.blend = 0.03, .is_flesh = true});
    for (int arm = 0; arm < 8; ++arm) {
        const double bend = arm % 2 == 0 ? 0.42 : 0.30;
        const double lift = arm % 2 == 0 ? 0.12 : 0.03;
        const auto at = [&](double out, double height, double turn, double radius) {
            const double angle = (arm + 0.5) * std::numbers::pi / 4.0 + turn * bend;
            return Ball(out * std::cos(angle), height, out * std::sin(angle), radius);
        };
        octopus.grow(fmt::format("arm {}", arm + 1),
                     {at(0.10, 0.17, 0.0, 0.092), at(0.32, 0.09, 0.0, 0.082),
                      at(0.58, 0.06, 0.2, 0.071), at(0.82, 0.07 + 0.3 * lift, 0.7, 0.061),
                      at(0.98, 0.10 + lift, 1.2, 0.053), at(1.00, 0.16 + 2.0 * lift, 1.7, 0.045)},
                     {.blend = 0.06});
    }
    return octopus;
}

Shape shape_cobra() {
    Shape cobra;
    cobra.grow("body", {{-1.05, 0.05, 0.06, 0.026},
                        {-0.80, 0.06, 0.22, 0.045},
                        {-0.50, 0.08, 0.02, 0.065},
                        {-0.22, 0.09, -0.22, 0.080},
                        {0.08, 0.09, -0.10, 0.088},
                        {0.16, 0.09, 0.20, 0.090},
                        {0.40, 0.10, 0.30, 0.090},
                        {0.58, 0.20, 0.12, 0.088},
                        {0.56, 0.45, 0.01, 0.084},
                        {0.48, 0.70, 0.00, 0.080},
                        {0.47, 0.95, 0.00, 0.075},
                        {0.55, 1.10, 0.00, 0.078},
                        {0.68, 1.12, 0.00, 0.072},
                        {0.80, 1.09, 0.00, 0.052}});
    cobra.grow("hood",
               {{0.50, 0.56, 0, 0.08},
                {0.48, 0.70, 0, 0.15},
                {0.47, 0.84, 0, 0.23},
                {0.48, 0.97, 0, 0.20},
                {0.50, 1.05, 0, 0.09}},
               {.blend = 0.05,
                .reach = 0.7,
                .squeeze = {.axis = {1, 0, 0}, .factor = 0.42},
                .is_flesh = true});
    cobra.grow("skull", {{0.58, 1.11, 0, 0.09}, {0.68, 1.12, 0, 0.115}, {0.79, 1.10, 0, 0.075}},
               {.blend = 0.04, .squeeze = {.axis = {0, 1, 0}, .factor = 0.68}, .is_flesh = true});
    return cobra;
}

Shape shape_frog() {
    Shape frog;
    frog.grow("back",
              {{-0.36, 0.20, 0, 0.19},
               {-0.10, 0.32, 0, 0.25},
               {0.14, 0.41, 0, 0.25},
               {0.34, 0.46, 0, 0.21},
               {0.50, 0.45, 0, 0.14}},
              {.squeeze = {.axis = glm::normalize(glm::dvec3(-0.35, 1.0, 0.0)), .factor = 0.78},
               .is_tube = false});
    frog.grow_pair("eye", {{0.33, 0.60, 0.13, 0.075}, {0.34, 0.61, 0.14, 0.075}},
                   {.blend = 0.03, .is_flesh = true});
    frog.grow_pair("hind leg",
                   {{-0.34, 0.20, 0.10, 0.14},
                    {-0.12, 0.26, 0.37, 0.105},
                    {0.06, 0.30, 0.51, 0.082},
                    {-0.16, 0.17, 0.60, 0.070},
                    {-0.38, 0.06, 0.58, 0.052},
                    {-0.20, 0.045, 0.66, 0.046}},
                   {.blend = 0.05});
    frog.grow_pair("fore leg",
                   {{0.22, 0.33, 0.16, 0.095},
                    {0.14, 0.20, 0.28, 0.070},
                    {0.20, 0.10, 0.32, 0.052},
                    {0.28, 0.045, 0.30, 0.042}},
                   {.blend = 0.05});
    const std::array<glm::dvec2, 3> spread = {{{0.25, -0.12}, {0.28, 0.04}, {0.20, 0.20}}};
    for (std::size_t toe = 0; toe < spread.size(); ++toe) {
        const auto grow_toe = [&](const char* foot, const Ball& from, double length) {
            const Ball step(length * spread[toe].x, 0, length * spread[toe].y, 0);
            const Ball low(0, -0.010, 0, -0.010);
            frog.grow_pair(fmt::format("{} toe {}", foot, toe + 1),
                           {from, from + 0.55 * step + low, from + step + low}, {.blend = 0.02});
        };
        grow_toe("hind", {-0.20, 0.045, 0.66, 0.046}, 1.0);
        grow_toe("fore", {0.28, 0.045, 0.30, 0.042}, 0.75);
    }
    return frog;
}

Shape shape_hand() {
    Shape hand;
    hand.grow("forearm", {{0.00, -0.75, 0, 0.17}, {0.00, -0.45, 0, 0.15}, {0.00, -0.20, 0, 0.13}},
              {.squeeze = {.factor = 0.75}, .is_tube = false});
    hand.grow("palm", {{0.00, -0.12, 0, 0.14}, {-0.01, 0.05, 0, 0.20}, {-0.01, 0.20, 0, 0.21}},
              {.blend = 0.08, .reach = 0.5, .squeeze = {.factor = 0.45}, .is_tube = false});
    hand.grow("thumb",
              {{-0.11, 0.00, 0.02, 0.095},
               {-0.26, 0.10, 0.06, 0.085},
               {-0.40, 0.24, 0.08, 0.070},
               {-0.48, 0.38, 0.08, 0.055}},
              {.blend = 0.06, .from = "palm"});
    hand.grow("index finger",
              {{-0.15, 0.30, 0, 0.072},
               {-0.23, 0.56, 0.01, 0.064},
               {-0.28, 0.74, 0.03, 0.057},
               {-0.31, 0.88, 0.06, 0.046}},
              {.blend = 0.05, .from = "palm"});
    hand.grow("middle finger",
              {{-0.04, 0.33, 0, 0.073},
               {-0.07, 0.63, 0.01, 0.065},
               {-0.08, 0.83, 0.03, 0.058},
               {-0.09, 0.98, 0.06, 0.047}},
              {.blend = 0.05, .from = "palm"});
    hand.grow("ring finger",
              {{0.07, 0.31, 0, 0.070},
               {0.10, 0.60, 0.01, 0.062},
               {0.12, 0.79, 0.03, 0.055},
               {0.13, 0.92, 0.06, 0.045}},
              {.blend = 0.05, .from = "palm"});
    hand.grow("little finger",
              {{0.15, 0.26, 0, 0.064},
               {0.25, 0.49, 0.01, 0.054},
               {0.30, 0.63, 0.03, 0.048},
               {0.33, 0.74, 0.06, 0.040}},
              {.blend = 0.05, .from = "palm"});
    return hand;
}

}  // namespace zskel::models
