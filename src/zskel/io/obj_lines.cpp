// Wavefront OBJ: a `v` for each node and an `l` for each edge; as tubes, `v` and `f`.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "zskel/io/format_io.h"
#include "zskel/io/tubes.h"
#include "zskel/io/write_mesh.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

/// Statements that say nothing about a skeleton.
constexpr std::array<std::string_view, 7> kSkipped = {"o",  "g",      "s",     "vt",
                                                      "vn", "mtllib", "usemtl"};

std::string vertex_line(const DVec3& p) {
    return fmt::format("v {} {} {}\n", p.x, p.y, p.z);
}

class ObjLinesReader {
  public:
    ObjLinesReader(std::string_view bytes, const std::string& name)
        : text_(bytes, name, {.hash_comments = true, .joined_lines = true}), name_(name) {}

    SkeletonFile read() {
        while (text_.to_content()) {
            const std::string_view keyword = text_.word();
            if (keyword == "v") {
                read_vertex();
            } else if (keyword == "l") {
                read_line();
            } else if (keyword == "f") {
                text_.fail("a face: this is a mesh; zskel extract makes a skeleton of it");
            } else if (std::find(kSkipped.begin(), kSkipped.end(), keyword) == kSkipped.end()) {
                text_.fail(fmt::format("{}; a skeleton has v and l", quoted(keyword)));
            }
            text_.next_line();
        }
        return builder_.finish(false, name_);
    }

  private:
    // What follows the three numbers, a weight or a colour, is left out.
    void read_vertex() {
        SkeletonGraph::Node node;
        node.position.x = text_.finite_number("coordinate x");
        node.position.y = text_.finite_number("coordinate y");
        node.position.z = text_.finite_number("coordinate z");
        builder_.add_node(node);
    }

    void read_line() {
        std::int64_t before = read_index();
        do {
            const std::int64_t next = read_index();
            const std::string complaint = builder_.add_edge(before, next);
            if (!complaint.empty()) text_.fail(complaint);
            before = next;
        } while (!text_.line_done());
    }

    /// v or v/vt, from 1 or back from -1; the vertex must be there already.
    std::int64_t read_index() {
        if (text_.line_done()) text_.fail("a line with one end");
        const std::size_t begin = text_.offset();
        const auto count = static_cast<std::int64_t>(builder_.node_count());
        std::int64_t index = 0;
        std::int64_t texture = 0;
        bool fine = text_.take_integer(index);
        if (fine && text_.take('/')) fine = text_.take_integer(texture);
        if (index < 0) index += count + 1;
        if (!fine || !text_.at_word_end() || index < 1 || index > count) {
            text_.fail(fmt::format("end {} of a line; expected one of the {} vertices so far",
                                   quoted(text_.word_from(begin)), count));
        }
        return index - 1;
    }

    TextCursor text_;
    std::string name_;
    SkeletonBuilder builder_;
};

}  // namespace

std::string write_obj_lines(const SkeletonGraph& graph) {
    std::string text = "# zskel curve skeleton: v = node, l = edge\n";
    for (const SkeletonGraph::Node& node : graph.nodes) text += vertex_line(node.position);
    for (const SkeletonGraph::Edge& edge : graph.edges)
        text += fmt::format("l {} {}\n", edge.source + 1, edge.target + 1);
    return text;
}

std::string write_obj_tubes(const SkeletonGraph& graph, const std::string& origin) {
    const TubeSurface tubes = tube_surface(graph);
    return write_obj_mesh(tubes.positions, tubes.triangles,
                          origin + "\n# curve skeleton, its branches as tubes");
}

SkeletonFile read_obj_lines(std::string_view bytes, const std::string& name) {
    return ObjLinesReader(bytes, name).read();
}

}  // namespace zskel
