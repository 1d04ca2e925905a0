// Wavefront OBJ after "Object Files (.obj)", Alias|Wavefront, version 3.0. Polygons only; an index
// may point at a vertex that follows later in the file, so the upper bound is checked at the end.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "zskel/core/error.h"
#include "zskel/mesh/formats.h"
#include "zskel/mesh/mesh_builder.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

/// Statements that say nothing about the surface: grouping, materials, display.
constexpr std::array<std::string_view, 15> kSkipped = {
    "g",     "o",        "s",        "mg",         "mtllib",    "usemtl", "usemap", "maplib",
    "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "lod",    "vp"};

/// Geometry that is not made of polygons: points, lines, free-form curves and surfaces.
constexpr std::array<std::string_view, 23> kNotPolygons = {
    "p",    "l",  "curv", "curv2", "surf",  "cstype", "deg", "bmat", "step", "parm", "trim", "hole",
    "scrv", "sp", "end",  "con",   "ctech", "stech",  "bsp", "bzp",  "cdc",  "cdp",  "res"};

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The numbers of one kind of statement (v, vt or vn), and the largest one that a face asked for.
struct Numbering {
    std::string_view what;
    std::int64_t count = 0;
    std::int64_t largest = 0;
    std::size_t largest_line = 0;
};

class ObjReader {
  public:
    ObjReader(std::string_view bytes, std::string_view name, const ReadOptions& options)
        : text_(bytes, name, {.hash_comments = true, .joined_lines = true}),
          name_(name),
          builder_(name, options.max_faces) {}

    Mesh read() {
        while (text_.to_content()) read_statement();
        for (const Numbering* kind : {&vertices_, &textures_, &normals_}) check_largest(*kind);
        builder_.warn(lines_and_points_, "points, lines and free-form statements left out");
        return builder_.finish();
    }

  private:
    void read_statement() {
        const std::string_view keyword = text_.word();
        if (keyword == "v") return read_vertex();
        if (keyword == "f" || keyword == "fo") return read_face();
        if (keyword == "vn") return read_unused(normals_, 3, 3);
        if (keyword == "vt") return read_unused(textures_, 1, 3);
        if (is_one_of(keyword, kNotPolygons)) {
            ++lines_and_points_;
        } else if (!is_one_of(keyword, kSkipped)) {
            text_.fail(fmt::format("{} is no statement of OBJ; expected v, vt, vn, f, ...",
                                   quoted(keyword)));
        }
        text_.next_line();
    }

    /// x y z, then w, r g b, or r g b a.
    void read_vertex() {
        DVec3 p;
        p.x = text_.finite_number("coordinate x");
        p.y = text_.finite_number("coordinate y");
        p.z = text_.finite_number("coordinate z");
        int more = 0;
        for (; !text_.line_done(); ++more) text_.number("weight or colour");
        if (more == 2 || more > 4) {
            text_.fail(fmt::format("{} numbers after 'v'; expected x y z, and then w or r g b [a]",
                                   more + 3));
        }
        text_.next_line();
        builder_.positions.push_back(p);
        ++vertices_.count;
    }

    void read_unused(Numbering& kind, int fewest, int most) {
        int numbers = 0;
        for (; !text_.line_done(); ++numbers) text_.number(kind.what);
        if (numbers < fewest || numbers > most) {
            text_.fail(fmt::format("{} numbers of a {}; expected {} to {}", numbers, kind.what,
                                   fewest, most));
        }
        text_.next_line();
        ++kind.count;
    }

    void read_face() {
        corners_.clear();
        while (!text_.line_done()) corners_.push_back(read_corner());
        if (corners_.size() < 3) {
            text_.fail(fmt::format("face with {} corners; expected 3 or more", corners_.size()));
        }
        text_.next_line();
        builder_.add_face(corners_);
    }

    /// v, v/vt, v//vn or v/vt/vn.
    std::uint32_t read_corner() {
        const std::size_t begin = text_.offset();
        const std::uint32_t vertex = read_index(vertices_, begin);
        if (text_.take('/')) {
            if (!text_.at_word_end() && !text_.take('/')) {
                read_index(textures_, begin);
                if (text_.take('/') && !text_.at_word_end()) read_index(normals_, begin);
            } else if (!text_.at_word_end()) {
                read_index(normals_, begin);
            }
        }
        if (!text_.at_word_end()) fail_corner(begin, "v, v/vt, v//vn or v/vt/vn");
        return vertex;
    }

    std::uint32_t read_index(Numbering& kind, std::size_t corner_begin) {
        std::int64_t index = 0;
        if (!text_.take_integer(index)) fail_corner(corner_begin, "v, v/vt, v//vn or v/vt/vn");
        if (index < 0) index += kind.count + 1;
        if (index <= 0 || index >= static_cast<std::int64_t>(kNone)) {
            fail_corner(corner_begin, fmt::format("1 or more, or -1 to -{} for the {} lines so far",
                                                  kind.count, kind.what));
        }
        if (index > kind.largest) {
            kind.largest = index;
            kind.largest_line = text_.line();
        }
        return static_cast<std::uint32_t>(index - 1);
    }

    [[noreturn]] void fail_corner(std::size_t begin, std::string_view expected) const {
        text_.fail(
            fmt::format("face corner {}; expected {}", quoted(text_.word_from(begin)), expected));
    }

    void check_largest(const Numbering& kind) const {
        if (kind.largest <= kind.count) return;
        throw InputError(fmt::format("{}:{}: face asks for {} {}, but the file has only {}", name_,
                                     kind.largest_line, kind.what, kind.largest, kind.count));
    }

    TextCursor text_;
    std::string_view name_;
    MeshBuilder builder_;
    Numbering vertices_{.what = "vertex"};
    Numbering textures_{.what = "texture vertex"};
    Numbering normals_{.what = "normal"};
    std::size_t lines_and_points_ = 0;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_obj(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    return ObjReader(bytes, name, options).read();
}

}  // namespace zskel
