#pragma once

#include <string>
#include <string_view>

namespace zskel {

/// Bytes as text of letters, digits, + and /, filled up with = (RFC 4648).
std::string base64(std::string_view bytes);

/// Bytes packed by zlib (RFC 1950), as small as it can.
std::string packed(std::string_view bytes);

}  // namespace zskel
