#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

#include "zskel/core/error.h"

namespace zskel {

/// Walks over binary data value by value and never reads past the end.
/// Every failure is an InputError "name: byte offset: ...", the offset counted from the file's
/// begin.
class ByteCursor {
  public:
    ByteCursor(std::string_view bytes, std::size_t begin, std::endian order, std::string_view name)
        : bytes_(bytes), at_(begin), order_(order), name_(name) {}

    std::size_t remaining() const { return bytes_.size() - at_; }
    void skip(std::size_t count) { at_ += std::min(count, remaining()); }

    template <typename T>
    T read(std::string_view what) {
        if (remaining() < sizeof(T)) {
            fail(0, fmt::format("the file ends within {}: expected {} bytes, found {}", what,
                                sizeof(T), remaining()));
        }
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
        if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return std::bit_cast<T>(raw);
    }

    /// Fails at the place `back` bytes before the cursor.
    [[noreturn]] void fail(std::size_t back, std::string_view text) const {
        throw InputError(fmt::format("{}: byte {}: {}", name_, at_ - back, text));
    }

  private:
    std::string_view bytes_;
    std::size_t at_;
    std::endian order_;
    std::string_view name_;
};

}  // namespace zskel
