#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "zskel/core/simd_targets.h"

#include <hwy/highway.h>

namespace zskel {

/// Instruction sets by Highway's names (HWY_AVX3 and so on). Its own dispatcher is not used: the
/// library that holds it measures a timer whenever it is loaded, which takes 5 ms.

/// The best of those compiled for that this machine has, or the one forced.
std::int64_t instruction_set();

/// All of them, best first.
std::vector<std::int64_t> usable_instruction_sets();

/// For tests; 0 gives the choice back. Not while anything else runs.
void force_instruction_set(std::int64_t target);

/// A function compiled for every instruction set, as those that have a name here: AVX-512, AVX2,
/// SSE4, and what every machine of this kind has.
template <typename Function>
Function* choose(const std::array<Function*, 4>& compiled) {
    switch (instruction_set()) {
        case HWY_AVX3:
            return compiled[0];
        case HWY_AVX2:
            return compiled[1];
        case HWY_SSE4:
            return compiled[2];
        default:
            return compiled[3];
    }
}

}  // namespace zskel

/// The `name` in HWY_NAMESPACE of the instruction set in use.
#define ZSKEL_DISPATCH(name)                                                  \
    zskel::choose<decltype(HWY_STATIC_DISPATCH(name))>(                       \
        {HWY_CHOOSE_AVX3(name), HWY_CHOOSE_AVX2(name), HWY_CHOOSE_SSE4(name), \
         &HWY_STATIC_DISPATCH(name)})
