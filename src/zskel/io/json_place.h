#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/core/types.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {

/// The value that a text holds.
/// @throws InputError when it is no JSON, or nests deeper than anything that is read: to write such
/// a value into a message, or to compare it, would take as deep a stack.
inline nlohmann::json parse_json(std::string_view bytes, const std::string& name) {
    constexpr int kDeepest = 100;
    const auto check_depth = [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
        if (depth > kDeepest)
            throw InputError(fmt::format("{}: values nest deeper than {} levels", name, kDeepest));
        return true;
    };
    try {
        return nlohmann::json::parse(bytes, check_depth);
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: no JSON: {}", name, error.what()));
    }
}

/// A value and where it stands: "a.json: nodes[3]: radius".
class JsonPlace {
  public:
    JsonPlace(const nlohmann::json& value, std::string where)
        : value_(value), where_(std::move(where)) {}

    const nlohmann::json& value() const { return value_; }
    bool has(const char* key) const { return value_.is_object() && value_.contains(key); }

    JsonPlace at(const char* key) const {
        if (!value_.is_object()) fail("an object");
        if (!value_.contains(key)) {
            throw InputError(fmt::format("{}: has no member {}", where_, zskel::quoted(key)));
        }
        return {value_[key], fmt::format("{}: {}", where_, key)};
    }
    JsonPlace at(std::size_t index) const {
        return {value_[index], fmt::format("{}[{}]", where_, index)};
    }
    std::size_t array_size() const {
        if (!value_.is_array()) fail("an array");
        return value_.size();
    }
    double number() const {
        if (!value_.is_number()) fail("a number");
        return value_.get<double>();
    }
    std::int64_t integer() const {
        const bool fits = value_.is_number_integer() &&
                          (!value_.is_number_unsigned() || value_.get<std::uint64_t>() <= kNone);
        if (!fits) fail("a whole number of 32 bits");
        return value_.get<std::int64_t>();
    }
    std::uint32_t count() const {
        const std::int64_t value = integer();
        if (value < 0 || value >= kNone) fail("a whole number from 0 up");
        return static_cast<std::uint32_t>(value);
    }
    DVec3 point() const {
        if (array_size() != 3) fail("three numbers");
        return {at(std::size_t{0}).number(), at(1).number(), at(2).number()};
    }
    [[noreturn]] void fail(std::string_view expected) const {
        throw InputError(fmt::format(
            "{}: {} is not {}", where_,
            zskel::quoted(value_.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)),
            expected));
    }
    /// Says what a builder found wrong; nothing when that is nothing.
    void check(const std::string& complaint) const {
        if (!complaint.empty()) throw InputError(fmt::format("{}: {}", where_, complaint));
    }

  private:
    const nlohmann::json& value_;
    std::string where_;
};

}  // namespace zskel
