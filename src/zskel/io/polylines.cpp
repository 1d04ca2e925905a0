// CGAL's polylines: a line for each branch, the number of its points and then their coordinates. A
// lone node is a line of one point.
#include <fmt/format.h>

#include <array>
#include <map>

#include "zskel/io/format_io.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

void add_point(std::string& text, const DVec3& p) {
    text += fmt::format(" {} {} {}", p.x, p.y, p.z);
}

/// Points are one node when all digits agree.
class PolylinesReader {
  public:
    PolylinesReader(std::string_view bytes, const std::string& name)
        : text_(bytes, name), name_(name) {}

    SkeletonFile read() {
        while (text_.to_content()) read_line();
        return builder_.finish(false, name_);
    }

  private:
    void read_line() {
        const std::int64_t count = text_.integer("number of points");
        if (count < 1) text_.fail(fmt::format("a polyline of {} points", count));
        std::int64_t before = read_point();
        for (std::int64_t i = 1; i < count; ++i) {
            const std::int64_t next = read_point();
            const std::string complaint = builder_.add_edge(before, next);
            if (!complaint.empty()) text_.fail(complaint);
            before = next;
        }
        text_.end_line("the polyline");
    }

    std::int64_t read_point() {
        SkeletonGraph::Node node;
        std::array<double, 3> place{};
        for (int axis = 0; axis < 3; ++axis) {
            place[static_cast<std::size_t>(axis)] = text_.finite_number("coordinate");
            node.position[axis] = place[static_cast<std::size_t>(axis)];
        }
        const auto [at, is_new] =
            numbers_.try_emplace(place, static_cast<std::int64_t>(builder_.node_count()));
        if (is_new) builder_.add_node(node);
        return at->second;
    }

    TextCursor text_;
    std::string name_;
    SkeletonBuilder builder_;
    std::map<std::array<double, 3>, std::int64_t> numbers_;
};

}  // namespace

std::string write_polylines(const SkeletonGraph& graph) {
    std::string text;
    for (const Branch& branch : find_branches(graph)) {
        text += fmt::format("{}", branch.nodes.size());
        for (const std::uint32_t n : branch.nodes) add_point(text, graph.nodes[n].position);
        text += '\n';
    }
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    for (std::size_t n = 0; n < degrees.size(); ++n) {
        if (degrees[n] > 0) continue;
        text += '1';
        add_point(text, graph.nodes[n].position);
        text += '\n';
    }
    return text;
}

std::string write_correspondence(const SkeletonGraph& graph, std::span<const DVec3> positions) {
    std::string text;
    for (std::size_t v = 0; v < graph.vertex_node.size(); ++v) {
        if (graph.vertex_node[v] == kNone) continue;
        text += '2';
        add_point(text, graph.nodes[graph.vertex_node[v]].position);
        add_point(text, positions[v]);
        text += '\n';
    }
    return text;
}

SkeletonFile read_polylines(std::string_view bytes, const std::string& name) {
    return PolylinesReader(bytes, name).read();
}

}  // namespace zskel
