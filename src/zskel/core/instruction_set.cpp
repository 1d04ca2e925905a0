#include "zskel/core/instruction_set.h"

namespace zskel {
namespace {

std::int64_t forced = 0;

std::vector<std::int64_t> find_usable() {
    std::vector<std::int64_t> usable;
#if HWY_ARCH_X86
    __builtin_cpu_init();
    const bool has_sse4 = __builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2") &&
                          __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("aes");
    // LZCNT and F16C came with these.
    const bool has_avx2 = has_sse4 && __builtin_cpu_supports("avx2") &&
                          __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    const bool has_avx3 = has_avx2 && __builtin_cpu_supports("avx512f") &&
                          __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
    if (has_avx3 && (HWY_TARGETS & HWY_AVX3) != 0) usable.push_back(HWY_AVX3);
    if (has_avx2 && (HWY_TARGETS & HWY_AVX2) != 0) usable.push_back(HWY_AVX2);
    if (has_sse4 && (HWY_TARGETS & HWY_SSE4) != 0) usable.push_back(HWY_SSE4);
#endif
    if (usable.empty() || usable.back() != HWY_STATIC_TARGET) usable.push_back(HWY_STATIC_TARGET);
    return usable;
}

}  // namespace

std::vector<std::int64_t> usable_instruction_sets() {
    static const std::vector<std::int64_t> usable = find_usable();
    return usable;
}

std::int64_t instruction_set() {
    static const std::int64_t best = usable_instruction_sets().front();
    return forced != 0 ? forced : best;
}

void force_instruction_set(std::int64_t target) {
    forced = target;
}

}  // namespace zskel
