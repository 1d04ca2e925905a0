#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace zskel {

/// Appends the bytes of a number, the lowest first.
template <typename T>
void append_little_endian(std::string& out, T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
    out.append(raw.data(), raw.size());
}

}  // namespace zskel
