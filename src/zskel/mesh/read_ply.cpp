// PLY 1.0 after G. Turk, "The PLY Polygon File Format", 1994. The element vertex gives x, y, z; the
// element face a list vertex_indices or vertex_index; everything else is checked and left out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "zskel/mesh/byte_cursor.h"
#include "zskel/mesh/formats.h"
#include "zskel/mesh/mesh_builder.h"
#include "zskel/mesh/ply_header.h"

namespace zskel {
namespace {

struct WholeRange {
    std::int64_t lowest;
    std::int64_t highest;
};

template <typename T>
constexpr WholeRange range_of() {
    return {std::numeric_limits<T>::min(), std::numeric_limits<T>::max()};
}

WholeRange range_of(PlyType type) {
    switch (type) {
        case PlyType::Int8:
            return range_of<std::int8_t>();
        case PlyType::Uint8:
            return range_of<std::uint8_t>();
        case PlyType::Int16:
            return range_of<std::int16_t>();
        case PlyType::Uint16:
            return range_of<std::uint16_t>();
        case PlyType::Int32:
            return range_of<std::int32_t>();
        default:
            return range_of<std::uint32_t>();
    }
}

/// Values of an ascii body: one element a line.
class AsciiValues {
  public:
    explicit AsciiValues(TextCursor text) : text_(text) {}

    /// Bytes that a value takes at least: a digit and what ends it.
    static std::size_t least_bytes(PlyType) { return 2; }
    /// The last line may lack its end.
    std::size_t remaining() const { return text_.remaining() + 1; }
    bool at_end() { return !text_.to_content(); }

    void begin_row(std::string_view element) {
        if (!text_.to_content()) fail(fmt::format("the file ends before the last {}", element));
    }
    void end_row(std::string_view element) { text_.end_line(element); }

    double number(PlyType type, std::string_view what) {
        return is_whole(type) ? static_cast<double>(whole(type, what)) : text_.number(what);
    }
    std::int64_t whole(PlyType type, std::string_view what) {
        const std::int64_t value = text_.integer(what);
        const WholeRange range = range_of(type);
        if (value < range.lowest || value > range.highest) {
            fail(fmt::format("{} is {}; its type holds {} to {}", what, value, range.lowest,
                             range.highest));
        }
        return value;
    }
    [[noreturn]] void fail(std::string_view text) const { text_.fail(text); }

  private:
    TextCursor text_;
};

/// Values of a binary body, one behind the other.
class BinaryValues {
  public:
    explicit BinaryValues(ByteCursor data) : data_(data) {}

    static std::size_t least_bytes(PlyType type) { return size_of(type); }
    std::size_t remaining() const { return data_.remaining(); }
    bool at_end() const { return data_.remaining() == 0; }

    static void begin_row(std::string_view) {}
    static void end_row(std::string_view) {}

    double number(PlyType type, std::string_view what) {
        if (type == PlyType::Float32) return last(data_.read<float>(what));
        if (type == PlyType::Float64) return last(data_.read<double>(what));
        return static_cast<double>(whole(type, what));
    }
    std::int64_t whole(PlyType type, std::string_view what) {
        switch (type) {
            case PlyType::Int8:
                return last(data_.read<std::int8_t>(what));
            case PlyType::Uint8:
                return last(data_.read<std::uint8_t>(what));
            case PlyType::Int16:
                return last(data_.read<std::int16_t>(what));
            case PlyType::Uint16:
                return last(data_.read<std::uint16_t>(what));
            case PlyType::Int32:
                return last(data_.read<std::int32_t>(what));
            default:
                return last(data_.read<std::uint32_t>(what));
        }
    }
    /// Fails at the value read last.
    [[noreturn]] void fail(std::string_view text) const { data_.fail(last_size_, text); }

  private:
    template <typename T>
    T last(T value) {
        last_size_ = sizeof value;
        return value;
    }

    ByteCursor data_;
    std::size_t last_size_ = 0;
};

bool is_index_list(const PlyProperty& property) {
    return property.name == "vertex_indices" || property.name == "vertex_index";
}

template <typename Values>
class PlyBody {
  public:
    PlyBody(Values values, const PlyHeader& header, std::string_view name,
            const ReadOptions& options)
        : values_(values), header_(header), builder_(name, options.max_faces) {}

    Mesh read() {
        check_elements();
        check_size();
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else {
                skip_rows(element);
            }
        }
        if (!values_.at_end()) values_.fail("more data after the last element of the header");
        return builder_.finish();
    }

  private:
    const PlyElement& find_element(std::string_view name) const {
        const auto& all = header_.elements;
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const PlyElement& e) { return e.name == name; });
        if (found == all.end())
            values_.fail(fmt::format("the header has no element {}", quoted(name)));
        return *found;
    }

    void check_elements() {
        const PlyElement& vertex = find_element("vertex");
        for (const std::string_view axis : {"x", "y", "z"}) {
            const auto fits = [&](const PlyProperty& p) {
                return p.name == axis && !p.list_size_type;
            };
            if (std::none_of(vertex.properties.begin(), vertex.properties.end(), fits)) {
                values_.fail(fmt::format("element 'vertex' has no number {}", quoted(axis)));
            }
        }
        vertex_count_ = vertex.count;
        const PlyElement& face = find_element("face");
        const auto lists =
            std::count_if(face.properties.begin(), face.properties.end(), is_index_list);
        const auto found =
            std::find_if(face.properties.begin(), face.properties.end(), is_index_list);
        if (lists != 1 || !found->list_size_type || !is_whole(found->type)) {
            values_.fail(
                "element 'face' needs one list 'vertex_indices' or 'vertex_index' of whole "
                "numbers");
        }
    }

    /// Nothing is allocated before every declared count fits into the bytes that are there.
    void check_size() const {
        std::size_t left = values_.remaining();
        for (const PlyElement& element : header_.elements) {
            std::size_t row = 0;
            for (const PlyProperty& property : element.properties) {
                row += Values::least_bytes(property.list_size_type.value_or(property.type));
                const bool is_face = element.name == "face" && is_index_list(property);
                if (is_face) row += 3 * Values::least_bytes(property.type);
            }
            if (row > 0 && element.count > left / row) {
                values_.fail(
                    fmt::format("{} of element {} declared, which take {} bytes or more each; "
                                "the file has {} left",
                                element.count, quoted(element.name), row, left));
            }
            left -= element.count * row;
        }
    }

    void read_vertices(const PlyElement& element) {
        builder_.positions.reserve(element.count);
        std::vector<int> axes;
        for (const PlyProperty& p : element.properties) {
            axes.push_back(p.name == "x" ? 0 : p.name == "y" ? 1 : p.name == "z" ? 2 : -1);
        }
        for (std::size_t row = 0; row < element.count; ++row) {
            values_.begin_row(element.name);
            DVec3 position(0.0);
            for (std::size_t i = 0; i < axes.size(); ++i) {
                if (axes[i] < 0) {
                    skip_property(element.properties[i]);
                } else {
                    position[axes[i]] = read_coordinate(element.properties[i]);
                }
            }
            values_.end_row(element.name);
            builder_.positions.push_back(position);
        }
    }

    double read_coordinate(const PlyProperty& property) {
        const double value = values_.number(property.type, property.label);
        if (!std::isfinite(value)) {
            values_.fail(fmt::format("{} is {}; expected a finite number", property.label, value));
        }
        return value;
    }

    void read_faces(const PlyElement& element) {
        builder_.reserve_faces(element.count);
        for (std::size_t row = 0; row < element.count; ++row) {
            values_.begin_row(element.name);
            for (const PlyProperty& property : element.properties) {
                if (is_index_list(property)) {
                    read_corners(property);
                } else {
                    skip_property(property);
                }
            }
            values_.end_row(element.name);
            builder_.add_face(corners_);
        }
    }

    void read_corners(const PlyProperty& property) {
        const std::size_t size = read_list_size(property);
        if (size < 3) values_.fail(fmt::format("face with {} corners; expected 3 or more", size));
        corners_.clear();
        for (std::size_t i = 0; i < size; ++i) {
            const std::int64_t index = values_.whole(property.type, property.label);
            if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
                values_.fail(fmt::format("face asks for vertex {}; expected 0 to {}", index,
                                         static_cast<std::int64_t>(vertex_count_) - 1));
            }
            corners_.push_back(static_cast<std::uint32_t>(index));
        }
    }

    std::size_t read_list_size(const PlyProperty& property) {
        const std::int64_t size = values_.whole(*property.list_size_type, property.label);
        const std::size_t most = values_.remaining() / Values::least_bytes(property.type);
        if (size < 0 || static_cast<std::uint64_t>(size) > most) {
            values_.fail(fmt::format("{} has a length of {}; the rest of the file holds 0 to {}",
                                     property.label, size, most));
        }
        return static_cast<std::size_t>(size);
    }

    void skip_property(const PlyProperty& property) {
        const std::size_t count = property.list_size_type ? read_list_size(property) : 1;
        for (std::size_t i = 0; i < count; ++i) values_.number(property.type, property.label);
    }

    void skip_rows(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (std::size_t row = 0; row < element.count; ++row) {
            values_.begin_row(element.name);
            for (const PlyProperty& property : element.properties) skip_property(property);
            values_.end_row(element.name);
        }
    }

    Values values_;
    const PlyHeader& header_;
    MeshBuilder builder_;
    std::size_t vertex_count_ = 0;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_ply(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    TextCursor text(bytes, name);
    const PlyHeader header = read_ply_header(text, bytes);
    if (header.encoding == PlyEncoding::Ascii) {
        return PlyBody(AsciiValues(text), header, name, options).read();
    }
    const std::endian order =
        header.encoding == PlyEncoding::BinaryBig ? std::endian::big : std::endian::little;
    const ByteCursor data(bytes, header.data_begin, order, name);
    return PlyBody(BinaryValues(data), header, name, options).read();
}

}  // namespace zskel
