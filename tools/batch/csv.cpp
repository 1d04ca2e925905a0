#include "batch/csv.h"

#include <fmt/format.h>

#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

class CsvReader {
  public:
    CsvReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

    std::vector<std::vector<std::string>> rows() {
        std::vector<std::vector<std::string>> all;
        while (at_ < text_.size()) {
            if (end_of_line()) continue;
            all.push_back(row());
        }
        return all;
    }

  private:
    std::vector<std::string> row() {
        std::vector<std::string> fields{field()};
        while (at_ < text_.size() && text_[at_] == ',') {
            ++at_;
            fields.push_back(field());
        }
        if (at_ < text_.size() && !end_of_line()) fail("a quote in the middle of a field");
        return fields;
    }

    std::string field() {
        if (at_ < text_.size() && text_[at_] == '"') return quoted_field();
        const std::size_t end = std::min(text_.find_first_of(",\"\r\n", at_), text_.size());
        std::string value(text_.substr(at_, end - at_));
        at_ = end;
        return value;
    }

    std::string quoted_field() {
        const std::size_t start_line = line_;
        std::string value;
        for (++at_; at_ < text_.size(); ++at_) {
            if (text_[at_] == '"') {
                if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') {
                    ++at_;
                    return value;
                }
                ++at_;
            }
            if (text_[at_] == '\n') ++line_;
            value += text_[at_];
        }
        line_ = start_line;
        fail("a quote that is not closed");
    }

    // Steps over one line's end.
    bool end_of_line() {
        const std::size_t start = at_;
        if (text_[at_] == '\r') ++at_;
        if (at_ < text_.size() && text_[at_] == '\n') ++at_;
        if (at_ > start) ++line_;
        return at_ > start;
    }

    [[noreturn]] void fail(const char* what) const {
        throw InputError(fmt::format("{}: line {}: {}", name_, line_, what));
    }

    std::string_view text_;
    std::string_view name_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

}  // namespace

std::vector<std::vector<std::string>> parse_csv(std::string_view text, std::string_view name) {
    return CsvReader(text, name).rows();
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of("\",\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

}  // namespace zskel::batch
