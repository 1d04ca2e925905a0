#include "zskel/mesh/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>

#include "zskel/core/types.h"

namespace zskel {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr std::array<TypeName, 16> kTypeNames = {{{"char", PlyType::Int8},
                                                  {"int8", PlyType::Int8},
                                                  {"uchar", PlyType::Uint8},
                                                  {"uint8", PlyType::Uint8},
                                                  {"short", PlyType::Int16},
                                                  {"int16", PlyType::Int16},
                                                  {"ushort", PlyType::Uint16},
                                                  {"uint16", PlyType::Uint16},
                                                  {"int", PlyType::Int32},
                                                  {"int32", PlyType::Int32},
                                                  {"uint", PlyType::Uint32},
                                                  {"uint32", PlyType::Uint32},
                                                  {"float", PlyType::Float32},
                                                  {"float32", PlyType::Float32},
                                                  {"double", PlyType::Float64},
                                                  {"float64", PlyType::Float64}}};

PlyType read_type(TextCursor& text) {
    const std::string_view word = text.word();
    const auto* const found = std::find_if(kTypeNames.begin(), kTypeNames.end(),
                                           [&](const TypeName& t) { return t.name == word; });
    if (found == kTypeNames.end()) {
        text.fail(
            fmt::format("{} is no type of PLY; expected char, uchar, short, ushort, int, uint, "
                        "float or double",
                        quoted(word)));
    }
    return found->type;
}

PlyEncoding read_encoding(TextCursor& text) {
    const std::string_view word = text.word();
    const std::string_view version = text.word();
    if (version != "1.0") text.fail(fmt::format("version {}; expected 1.0", quoted(version)));
    if (word == "ascii") return PlyEncoding::Ascii;
    if (word == "binary_little_endian") return PlyEncoding::BinaryLittle;
    if (word == "binary_big_endian") return PlyEncoding::BinaryBig;
    text.fail(fmt::format("format {}; expected ascii, binary_little_endian or binary_big_endian",
                          quoted(word)));
}

std::string_view read_name(TextCursor& text, std::string_view what) {
    const std::string_view name = text.word();
    if (name.empty()) text.fail(fmt::format("{} without a name", what));
    return name;
}

using Names = std::unordered_set<std::string_view>;

void refuse_second(const TextCursor& text, Names& earlier, std::string_view name,
                   std::string_view what) {
    if (!earlier.insert(name).second)
        text.fail(fmt::format("{} {} is declared twice", what, quoted(name)));
}

PlyElement read_element(TextCursor& text, Names& earlier) {
    PlyElement element;
    element.name = read_name(text, "element");
    refuse_second(text, earlier, element.name, "element");
    const std::int64_t count = text.integer("number of elements");
    if (count < 0 || count >= static_cast<std::int64_t>(kNone)) {
        text.fail(fmt::format("{} of element {} declared; expected 0 to {}", count,
                              quoted(element.name), kNone - 1));
    }
    element.count = static_cast<std::size_t>(count);
    return element;
}

PlyProperty read_property(TextCursor& text, const PlyElement& element, Names& earlier) {
    PlyProperty property;
    if (text.peek_word() == "list") {
        text.word();
        property.list_size_type = read_type(text);
        if (!is_whole(*property.list_size_type)) {
            text.fail(
                "a list whose length is float or double; expected a whole type such as uchar");
        }
    }
    property.type = read_type(text);
    property.name = read_name(text, "property");
    refuse_second(text, earlier, property.name, "property");
    property.label =
        fmt::format("property {} of element {}", quoted(property.name), quoted(element.name));
    return property;
}

/// Offset behind the line end that follows end_header. A lone CR there is a line end only if the
/// header's first line ends so, too: the byte behind it may be data that looks like LF.
std::size_t find_data_begin(std::string_view bytes, std::size_t header_end) {
    const std::size_t first_end = bytes.find_first_of("\r\n");
    const bool lone_cr = bytes.substr(first_end, 1) == "\r" && bytes.substr(first_end, 2) != "\r\n";
    if (!lone_cr && bytes.substr(header_end, 2) == "\r\n") return header_end + 2;
    return std::min(header_end + 1, bytes.size());
}

}  // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
        case PlyType::Int8:
        case PlyType::Uint8:
            return 1;
        case PlyType::Int16:
        case PlyType::Uint16:
            return 2;
        case PlyType::Int32:
        case PlyType::Uint32:
        case PlyType::Float32:
            return 4;
        case PlyType::Float64:
            return 8;
    }
    return 0;
}

bool is_whole(PlyType type) {
    return type != PlyType::Float32 && type != PlyType::Float64;
}

PlyHeader read_ply_header(TextCursor& text, std::string_view bytes) {
    const std::string_view magic = text.word();
    if (magic != "ply") text.fail(fmt::format("{} begins the file; expected ply", quoted(magic)));
    text.end_line("ply");
    PlyHeader header;
    Names elements;
    Names properties;  // of the last element
    bool has_format = false;
    while (text.to_content()) {
        const std::string_view keyword = text.word();
        if (keyword == "end_header") {
            if (!has_format) text.fail("the header ends without a line 'format'");
            header.data_begin = find_data_begin(bytes, text.offset());
            text.end_line("end_header");
            return header;
        }
        if (keyword == "comment" || keyword == "obj_info") {
            text.next_line();
            continue;
        }
        if (keyword == "format") {
            if (has_format) text.fail("a second line 'format'");
            has_format = true;
            header.encoding = read_encoding(text);
        } else if (keyword == "element") {
            header.elements.push_back(read_element(text, elements));
            properties = {};  // clear() would keep, and sweep, the places of the most there were
        } else if (keyword == "property") {
            if (header.elements.empty()) text.fail("a property before the first element");
            PlyElement& element = header.elements.back();
            element.properties.push_back(read_property(text, element, properties));
        } else {
            text.fail(
                fmt::format("{} in the header; expected format, comment, element, property or "
                            "end_header",
                            quoted(keyword)));
        }
        text.end_line(keyword);
    }
    text.fail("the file ends within the header; expected end_header");
}

}  // namespace zskel
