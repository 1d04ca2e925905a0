// Object File Format after the manual of Geomview 1.9 ("OFF Files"), text form, three dimensions.
// Differs: one vertex and one face a line, which the manual only recommends: that is what makes a
// missing or surplus number show where it is.
#include <fmt/format.h>

#include <algorithm>

#include "zskel/mesh/formats.h"
#include "zskel/mesh/mesh_builder.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

/// Bytes of the shortest vertex ("0 0 0") and face ("3 0 1 2"), each with its line end.
constexpr std::uint64_t kShortestVertex = 6;
constexpr std::uint64_t kShortestFace = 8;

/// What the header word says about the numbers on a vertex line, after x y z.
struct OffHeader {
    std::string_view word;
    bool texture = false;
    bool colour = false;
    bool normal = false;
};

class OffReader {
  public:
    OffReader(std::string_view bytes, std::string_view name, const ReadOptions& options)
        : text_(bytes, name, {.hash_comments = true}), builder_(name, options.max_faces) {}

    Mesh read() {
        read_header();
        read_counts();
        builder_.positions.reserve(vertex_count_);
        builder_.reserve_faces(face_count_);
        for (std::size_t i = 0; i < vertex_count_; ++i) read_vertex(i);
        for (std::size_t i = 0; i < face_count_; ++i) read_face(i);
        if (text_.to_content()) {
            text_.fail(fmt::format("{} after the last of {} faces; expected the end of the file",
                                   quoted(text_.word()), face_count_));
        }
        builder_.warn(bare_colours_,
                      "vertex lines carry colours that the header does not announce");
        return builder_.finish();
    }

  private:
    void read_header() {
        const std::string_view word = text_.to_content() ? text_.word() : std::string_view{};
        header_.word = word;
        std::string_view rest = word;
        const auto take = [&rest](std::string_view prefix) {
            const bool found = rest.substr(0, prefix.size()) == prefix;
            if (found) rest.remove_prefix(prefix.size());
            return found;
        };
        header_.texture = take("ST");
        header_.colour = take("C");
        header_.normal = take("N");
        if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
            text_.fail(fmt::format("{} has vertices of 4 or n dimensions; expected OFF in 3",
                                   quoted(word)));
        }
        if (rest != "OFF") {
            text_.fail(fmt::format("{} begins the file; expected OFF, COFF, NOFF, CNOFF or STOFF",
                                   quoted(word)));
        }
        if (text_.peek_word() == "BINARY") {
            text_.fail("'OFF BINARY' is not read; expected OFF in text form");
        }
    }

    std::size_t read_count(std::string_view what) {
        const std::int64_t count = text_.integer(what);
        if (count < 0 || count >= static_cast<std::int64_t>(kNone)) {
            text_.fail(fmt::format("{} {}; expected 0 to {}", what, count, kNone - 1));
        }
        return static_cast<std::size_t>(count);
    }

    void read_counts() {
        if (!text_.to_content())
            text_.fail("the file ends before the counts of vertices and faces");
        vertex_count_ = read_count("number of vertices");
        face_count_ = read_count("number of faces");
        read_count("number of edges");
        // Checked on this line, whose own end stands in for the last one, which a file may lack.
        const std::uint64_t needed = vertex_count_ * kShortestVertex + face_count_ * kShortestFace;
        if (needed > text_.remaining()) {
            text_.fail(
                fmt::format("{} vertices and {} faces declared, which take {} bytes or more; "
                            "the file has {} left",
                            vertex_count_, face_count_, needed, text_.remaining()));
        }
        text_.end_line("the counts of vertices, faces and edges");
    }

    void read_vertex(std::size_t vertex) {
        if (!text_.to_content()) {
            text_.fail(fmt::format("the file ends after {} of {} vertices", vertex, vertex_count_));
        }
        DVec3 p;
        p.x = text_.finite_number("coordinate x");
        p.y = text_.finite_number("coordinate y");
        p.z = text_.finite_number("coordinate z");
        std::size_t extras = 0;
        for (; !text_.line_done(); ++extras) text_.number("normal, colour or texture coordinate");
        check_extras(extras);
        text_.next_line();
        builder_.positions.push_back(p);
    }

    /// After x y z: a normal, a colour of 3 or 4 numbers and a texture coordinate, as announced.
    void check_extras(std::size_t extras) {
        const std::size_t fixed = (header_.normal ? 3 : 0) + (header_.texture ? 2 : 0);
        const std::size_t colour = extras - std::min(fixed, extras);
        const bool colour_fits = colour == 3 || colour == 4;
        if (extras >= fixed && (header_.colour ? colour_fits : colour == 0)) return;
        if (fixed == 0 && !header_.colour && colour_fits) {
            ++bare_colours_;
            return;
        }
        text_.fail(fmt::format("{} numbers after x y z; the header {} announces {}{}", extras,
                               header_.word, fixed,
                               header_.colour ? " and a colour of 3 or 4" : ""));
    }

    void read_face(std::size_t face) {
        if (!text_.to_content()) {
            text_.fail(fmt::format("the file ends after {} of {} faces", face, face_count_));
        }
        const std::int64_t corners = text_.integer("number of corners");
        if (corners < 3)
            text_.fail(fmt::format("face with {} corners; expected 3 or more", corners));
        if (static_cast<std::uint64_t>(corners) > text_.remaining() / 2) {
            text_.fail(fmt::format("face with {} corners; the file has {} bytes left", corners,
                                   text_.remaining()));
        }
        corners_.clear();
        for (std::int64_t i = 0; i < corners; ++i) corners_.push_back(read_corner());
        std::size_t colours = 0;
        for (; !text_.line_done(); ++colours) text_.number("face colour");
        if (colours == 2 || colours > 4) {
            text_.fail(
                fmt::format("{} numbers after the {} corners of a face; expected a colour of "
                            "1, 3 or 4, or none",
                            colours, corners));
        }
        text_.next_line();
        builder_.add_face(corners_);
    }

    std::uint32_t read_corner() {
        const std::int64_t index = text_.integer("vertex of a face");
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
            text_.fail(fmt::format("face asks for vertex {}; expected 0 to {}", index,
                                   static_cast<std::int64_t>(vertex_count_) - 1));
        }
        return static_cast<std::uint32_t>(index);
    }

    TextCursor text_;
    MeshBuilder builder_;
    OffHeader header_;
    std::size_t vertex_count_ = 0;
    std::size_t face_count_ = 0;
    std::size_t bare_colours_ = 0;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh read_off(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    return OffReader(bytes, name, options).read();
}

}  // namespace zskel
