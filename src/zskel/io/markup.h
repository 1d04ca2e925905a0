#pragma once

#include <string>
#include <string_view>

namespace zskel {

/// Text as it stands in HTML, SVG and XML, within an attribute's quotes too; control characters,
/// which XML has no place for, as question marks.
std::string escaped_markup(std::string_view text);

}  // namespace zskel
