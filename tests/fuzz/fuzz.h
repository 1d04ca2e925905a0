#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "zskel/core/error.h"

namespace zskel::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program, which is a finding, unless `promise` was kept.
inline void require(bool promise, const char* what) {
    if (promise) return;
    std::fprintf(stderr, "zskel: broken promise: %s\n", what);
    std::abort();
}

/// Runs `work`; a refusal is an answer like any other. Whatever else is thrown is a finding.
template <typename Work>
void answer(Work work) {
    try {
        work();
    } catch (const Error& error) {
        require(error.code() != ExitCode::Internal, error.what());
    }
}

}  // namespace zskel::fuzz
