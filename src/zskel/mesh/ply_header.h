#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/mesh/text_cursor.h"

namespace zskel {

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
enum class PlyEncoding { Ascii, BinaryLittle, BinaryBig };

std::size_t size_of(PlyType type);
bool is_whole(PlyType type);

struct PlyProperty {
    std::string_view name;
    std::string label;                      ///< for messages: property 'x' of element 'vertex'
    PlyType type = PlyType::Float32;        ///< of the value, or of each value of the list
    std::optional<PlyType> list_size_type;  ///< set when it is a list
};

struct PlyElement {
    std::string_view name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::Ascii;
    std::vector<PlyElement> elements;
    std::size_t data_begin = 0;  ///< offset of the first byte after the header
};

/// Reads from the cursor's place (the file's begin) to the end of the header's last line.
/// Throws InputError on what is no header of PLY 1.0; counts are not yet compared with the file's
/// size.
PlyHeader read_ply_header(TextCursor& text, std::string_view bytes);

}  // namespace zskel
