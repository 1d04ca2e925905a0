#include "zskel/mesh/text_cursor.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "zskel/core/error.h"

namespace zskel {
namespace {

constexpr std::size_t kLongestQuote = 40;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Every whole number up to here is a double, and so is every power of ten below: one division of
/// two such is then rounded once, correctly.
constexpr std::uint64_t kLargestExact = std::uint64_t{1} << 53;
constexpr std::array<double, 19> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                                 1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                                 1e14, 1e15, 1e16, 1e17, 1e18};

/// What from_chars calls out of range is 0 when it is too small to tell, an infinity when too
/// large.
double out_of_range_value(const char* begin, const char* end) {
    return std::strtod(std::string(begin, end).c_str(), nullptr);
}

}  // namespace

std::string quoted(std::string_view seen) {
    std::string text = "'";
    for (const char c : seen.substr(0, kLongestQuote)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte < 0x7F) {
            text += c;
        } else {
            text += fmt::format("\\x{:02x}", byte);
        }
    }
    return text + (seen.size() > kLongestQuote ? "...'" : "'");
}

TextCursor::TextCursor(std::string_view text, std::string_view name, TextRules rules)
    : begin_(text.data()),
      at_(text.data()),
      end_(text.data() + text.size()),
      name_(name),
      rules_(rules) {
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) at_ += kByteOrderMark.size();
}

bool TextCursor::skip_joint() {
    if (!rules_.joined_lines || !is_joint(at_)) return false;
    if (at_ + 1 == end_) return true;
    ++line_;
    ++at_;
    if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    return true;
}

void TextCursor::next_line() {
    const bool is_comment = rules_.hash_comments && at_ != end_ && *at_ == '#';
    const bool joins = rules_.joined_lines && !is_comment;
    while (at_ != end_ && !is_line_end(*at_)) {
        if (joins && *at_ == '\\') skip_joint();
        ++at_;
    }
    if (at_ == end_) return;
    if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
}

bool TextCursor::to_content() {
    while (line_done()) {
        if (at_ == end_) return false;
        next_line();
    }
    return true;
}

void TextCursor::end_line(std::string_view what) {
    if (!line_done()) fail(fmt::format("{} after {}", quoted(word()), what));
    next_line();
}

std::string_view TextCursor::word() {
    if (line_done()) return {};
    const char* first = at_;
    while (!ends_word(at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
}

double TextCursor::number(std::string_view what) {
    if (line_done()) fail(fmt::format("expected {}, found the end of the line", what));
    double value = 0.0;
    return take_short_number(value) ? value : take_any_number(what);
}

/// The usual case, several times as fast as from_chars: no exponent, and exact (see kLargestExact).
bool TextCursor::take_short_number(double& value) {
    const char* at = at_;
    if (*at == '-' || *at == '+') ++at;
    std::uint64_t digits = 0;
    const char* first = at;
    for (; at != end_ && is_digit(*at) && at - first < kMostDigits; ++at) {
        digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
    }
    std::ptrdiff_t count = at - first;
    std::size_t decimals = 0;
    if (at != end_ && *at == '.') {
        first = ++at;
        for (; at != end_ && is_digit(*at) && at - first < kMostDigits - count; ++at) {
            digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
        }
        decimals = static_cast<std::size_t>(at - first);
        count += at - first;
    }
    if (count == 0 || digits > kLargestExact || !ends_word(at)) return false;
    const double size = static_cast<double>(digits) / kPowersOfTen[decimals];
    value = *at_ == '-' ? -size : size;
    at_ = at;
    return true;
}

double TextCursor::take_any_number(std::string_view what) {
    const char* word_begin = at_;
    const char* first = *at_ == '+' ? at_ + 1 : at_;
    double value = 0.0;
    const auto [past, error] = std::from_chars(first, end_, value);
    const bool signed_twice = first != at_ && first != end_ && *first == '-';
    if (error == std::errc::invalid_argument || signed_twice || !ends_word(past)) {
        fail_word(word_begin, what, "a number");
    }
    if (error == std::errc::result_out_of_range) value = out_of_range_value(first, past);
    at_ = past;
    return value;
}

double TextCursor::finite_number(std::string_view what) {
    line_done();
    const char* word_begin = at_;
    const double value = number(what);
    if (!std::isfinite(value)) fail_word(word_begin, what, "a finite number");
    return value;
}

std::int64_t TextCursor::integer(std::string_view what) {
    if (line_done()) fail(fmt::format("expected {}, found the end of the line", what));
    const char* word_begin = at_;
    std::int64_t value = 0;
    if (!take_integer(value) || !ends_word(at_)) fail_word(word_begin, what, "a whole number");
    return value;
}

std::string_view TextCursor::word_from(std::size_t begin) const {
    const char* past = begin_ + begin;
    while (!ends_word(past)) ++past;
    return {begin_ + begin, static_cast<std::size_t>(past - begin_) - begin};
}

void TextCursor::fail(std::string_view text) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, text));
}

void TextCursor::fail_word(const char* begin, std::string_view what,
                           std::string_view expected) const {
    const std::string_view seen = word_from(static_cast<std::size_t>(begin - begin_));
    fail(fmt::format("{} {} is not {}", what, quoted(seen), expected));
}

}  // namespace zskel
