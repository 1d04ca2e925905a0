#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace zskel {

/// A piece of input as it stands in messages: quoted, unprintable bytes escaped, cut when long.
std::string quoted(std::string_view seen);

/// What a text format allows besides blanks and line ends.
struct TextRules {
    bool hash_comments = false;  ///< a word that begins with '#' ends the line
    bool joined_lines = false;   ///< a backslash at the end of a line (of no comment) continues it
};

/// Walks over a text word by word, knows the line, and never reads past the end.
/// Line ends are LF, CRLF or CR. Every failure is an InputError "name:line: ...".
class TextCursor {
  public:
    TextCursor(std::string_view text, std::string_view name, TextRules rules = {});

    std::size_t line() const { return line_; }
    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
    std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }

    /// Skips blanks; true when nothing is left on this line.
    bool line_done() {
        while (at_ != end_ && (is_blank(*at_) || (*at_ == '\\' && skip_joint()))) ++at_;
        return at_ == end_ || is_line_end(*at_) || (rules_.hash_comments && *at_ == '#');
    }

    /// Goes to the beginning of the next line.
    void next_line();

    /// Goes to the next word, over any number of line ends; false when there is none.
    bool to_content();

    /// Goes to the next line; what is left on this one is an error.
    void end_line(std::string_view what);

    /// The next word of this line; empty when the line is done.
    std::string_view word();

    /// The next word of this line as a number (infinities and NaN pass); `what` stands in messages.
    double number(std::string_view what);

    /// The same; must be finite.
    double finite_number(std::string_view what);

    /// The next word of this line as a whole number.
    std::int64_t integer(std::string_view what);

    /// Digits with or without a sign right here, whatever follows; false when there are none, or
    /// more than kMostDigits.
    bool take_integer(std::int64_t& value) {
        const char* at = at_;
        const bool is_negative = at != end_ && *at == '-';
        if (at != end_ && (*at == '-' || *at == '+')) ++at;
        const char* first = at;
        std::int64_t digits = 0;
        for (; at != end_ && is_digit(*at); ++at) {
            if (at - first == kMostDigits) return false;
            digits = digits * 10 + (*at - '0');
        }
        if (at == first) return false;
        value = is_negative ? -digits : digits;
        at_ = at;
        return true;
    }
    /// Steps over `c` if it is right here.
    bool take(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }
    bool at_word_end() const { return ends_word(at_); }

    /// The next word of this line; the cursor stays.
    std::string_view peek_word() const { return TextCursor(*this).word(); }

    /// The word around the cursor from `begin` (an earlier offset()) to its end.
    std::string_view word_from(std::size_t begin) const;

    [[noreturn]] void fail(std::string_view text) const;

  private:
    static constexpr int kMostDigits = 18;  // any number of so many digits fits 64 bits

    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
    bool is_joint(const char* p) const {
        return *p == '\\' && (p + 1 == end_ || is_line_end(p[1]));
    }
    bool ends_word(const char* p) const {
        return p == end_ || is_blank(*p) || is_line_end(*p) || (rules_.joined_lines && is_joint(p));
    }
    bool skip_joint();
    bool take_short_number(double& value);
    double take_any_number(std::string_view what);
    [[noreturn]] void fail_word(const char* begin, std::string_view what,
                                std::string_view expected) const;

    const char* begin_;
    const char* at_;
    const char* end_;
    std::string_view name_;
    TextRules rules_;
    std::size_t line_ = 1;
};

}  // namespace zskel
