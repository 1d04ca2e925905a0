#pragma once

#include <cstdint>

#include <string>
#include <string_view>

namespace zskel::scoring {

/// Bytes in the 64 letters of RFC 4648, padded.
inline std::string base64(std::string_view bytes) {
    constexpr const char* kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned char byte = i + k < bytes.size() ? bytes[i + k] : 0;
            three = three << 8 | byte;
        }
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? kLetters[three >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

}  // namespace zskel::scoring
