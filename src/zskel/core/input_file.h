#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace zskel {

/// What a file holds. (A string would be filled with zeros first.)
struct FileBytes {
    std::unique_ptr<char[]> data;
    std::size_t size = 0;

    std::string_view text() const { return {data.get(), size}; }
};

/// All bytes of a file, or of standard input for "-".
/// @param expected  stands in the message: "an OBJ file".
/// @throws InputError naming the path and the system's reason.
FileBytes read_input_file(const std::string& path, std::string_view expected);

}  // namespace zskel
