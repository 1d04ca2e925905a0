// Bezier patches in the form in which Newell's teapot is handed round: the number of patches; of
// each its two degrees and its control points, row by row.
#include <fmt/format.h>

#include "zskel/mesh/formats.h"
#include "zskel/mesh/parametric.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

constexpr std::int64_t kMostDegree = 25;
constexpr std::size_t kShortestPoint = 6;  // "0 0 0" and a line end

std::int64_t read_count(TextCursor& text, std::string_view what, std::int64_t least,
                        std::int64_t most) {
    if (!text.to_content()) text.fail(fmt::format("the file ends before {}", what));
    const std::int64_t value = text.integer(what);
    if (value < least || value > most)
        text.fail(fmt::format("{} is {}; expected {}{}", what, value, least,
                              most > least ? fmt::format(" to {}", most) : std::string()));
    return value;
}

DVec3 read_point(TextCursor& text) {
    DVec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        if (!text.to_content()) text.fail("the file ends within a control point");
        point[axis] = text.finite_number("a coordinate of a control point");
    }
    return point;
}

}  // namespace

Mesh read_bpt(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    TextCursor text(bytes, name, {.hash_comments = true, .joined_lines = false});
    const auto most = static_cast<std::int64_t>(bytes.size() / (4 * kShortestPoint) + 1);
    const std::int64_t patches = read_count(text, "the number of patches", 1, most);
    PatchGroup group;
    for (std::int64_t p = 0; p < patches; ++p) {
        const std::int64_t rows = read_count(text, "a patch's first degree", 1, kMostDegree) + 1;
        const std::int64_t columns =
            read_count(text, "a patch's second degree", 1, kMostDegree) + 1;
        std::vector<std::vector<DVec3>> points(static_cast<std::size_t>(rows));
        for (std::vector<DVec3>& row : points) {
            for (std::int64_t c = 0; c < columns; ++c) row.push_back(read_point(text));
        }
        group.push_back(bezier_patch(std::move(points)));
    }
    if (text.to_content()) {
        text.fail(fmt::format("{} after the last of {} patches; expected the end of the file",
                              quoted(text.word()), patches));
    }
    return tessellate({group}, options.chord_error, std::string(name), options.max_faces);
}

}  // namespace zskel
