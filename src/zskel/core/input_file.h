#pragma once

#include <string>
#include <string_view>

namespace zskel {

/// All bytes of a file, or of standard input for "-".
/// @param expected  stands in the message: "an OBJ file".
/// @throws InputError naming the path and the system's reason.
std::string read_input_file(const std::string& path, std::string_view expected);

}  // namespace zskel
