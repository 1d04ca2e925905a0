#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zskel::batch {

/// The rows of a CSV file (RFC 4180): fields in double quotes may hold commas, line breaks and
/// doubled quotes. Lines without any character are left out.
/// @param name  stands in messages. @throws InputError naming the line of a quote that is not
/// closed or that stands in the middle of a field.
std::vector<std::vector<std::string>> parse_csv(std::string_view text, std::string_view name);

/// A text as a field of such a file, in quotes where it needs them.
std::string csv_field(const std::string& text);

}  // namespace zskel::batch
