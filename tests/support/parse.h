#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "zskel/core/error.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::test {

inline Mesh parse(std::string_view text, MeshFormat format) {
    return parse_mesh(std::as_bytes(std::span(text.data(), text.size())), format, "model");
}

/// What the InputError says; "read without an error" when there was none.
inline std::string error_of(std::string_view text, MeshFormat format) {
    try {
        parse(text, format);
    } catch (const InputError& error) {
        return error.what();
    }
    return "read without an error";
}

/// Something malformed, and a piece of text that the message must contain.
struct Malformed {
    std::string text;
    std::string message;
};

inline bool contains(std::string_view text, std::string_view piece) {
    return text.find(piece) != std::string_view::npos;
}

/// The bytes of a value in the given order.
template <typename T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return raw;
}

}  // namespace zskel::test
