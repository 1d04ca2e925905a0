// Stanford PLY in ascii, with the elements that its author lists for wire frames: vertex, and edge
// with vertex1 and vertex2. As tubes: vertex and face.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "zskel/core/error.h"
#include "zskel/io/format_io.h"
#include "zskel/io/tubes.h"
#include "zskel/mesh/ply_header.h"

namespace zskel {
namespace {

std::string header_begin(const std::string& origin, std::string_view comment) {
    return fmt::format("ply\nformat ascii 1.0\ncomment {}\ncomment {}\n", origin, comment);
}

/// The column of a property that is one number; -1 when there is none.
int find_column(const PlyElement& element, std::string_view name) {
    const auto found =
        std::find_if(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& p) { return p.name == name && !p.list_size_type; });
    return found == element.properties.end() ? -1
                                             : static_cast<int>(found - element.properties.begin());
}

class PlyEdgesReader {
  public:
    PlyEdgesReader(std::string_view bytes, const std::string& name)
        : text_(bytes, name), name_(name), header_(read_ply_header(text_, bytes)) {}

    SkeletonFile read() {
        if (header_.encoding != PlyEncoding::Ascii)
            text_.fail("a binary PLY; skeletons are read from ascii ones");
        bool has_radii = false;
        bool has_edges = false;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                has_radii = find_column(element, "radius") >= 0;
                read_vertices(element);
            } else if (element.name == "edge") {
                has_edges = true;
                read_edges(element);
            } else {
                text_.fail(fmt::format(
                    "an element {}; a skeleton has vertex and edge, and zskel extract makes one of "
                    "a mesh",
                    quoted(element.name)));
            }
        }
        if (!has_edges) text_.fail("no element 'edge'; expected a skeleton");
        if (text_.to_content()) text_.fail("more data after the last element");
        return builder_.finish(has_radii, name_);
    }

  private:
    int column(const PlyElement& element, std::string_view name) const {
        const int found = find_column(element, name);
        if (found < 0) {
            text_.fail(
                fmt::format("element {} has no number {}", quoted(element.name), quoted(name)));
        }
        return found;
    }

    void read_row(const PlyElement& element) {
        if (!text_.to_content())
            text_.fail(fmt::format("the file ends before the last {}", element.name));
        row_.clear();
        for (const PlyProperty& property : element.properties) {
            if (property.list_size_type) text_.fail(property.label + " is a list");
            row_.push_back(text_.finite_number(property.label));
        }
        text_.end_line(element.name);
    }

    double value(int column, double otherwise) const {
        return column < 0 ? otherwise : row_[static_cast<std::size_t>(column)];
    }

    /// A value that must be whole; what is not is a number that no check lets pass.
    std::int64_t whole(int column) const {
        const double number = value(column, 0.0);
        const bool fine = number >= 0.0 && number < kNone && std::floor(number) == number;
        return fine ? static_cast<std::int64_t>(number) : -1;
    }

    void read_vertices(const PlyElement& element) {
        const int x = column(element, "x");
        const int y = column(element, "y");
        const int z = column(element, "z");
        const int radius = find_column(element, "radius");
        const int volume = find_column(element, "volume");
        const int solid = find_column(element, "solid");
        for (std::size_t i = 0; i < element.count; ++i) {
            const TextCursor place = text_;
            read_row(element);
            if (whole(solid) < 0) place.fail("the solid is not a whole number from 0 up");
            check(place, builder_.add_node({{value(x, 0.0), value(y, 0.0), value(z, 0.0)},
                                            value(radius, 0.0),
                                            static_cast<std::uint32_t>(whole(solid)),
                                            value(volume, 0.0)}));
        }
    }

    void read_edges(const PlyElement& element) {
        const int first = column(element, "vertex1");
        const int second = column(element, "vertex2");
        for (std::size_t i = 0; i < element.count; ++i) {
            const TextCursor place = text_;
            read_row(element);
            check(place, builder_.add_edge(whole(first), whole(second)));
        }
    }

    static void check(const TextCursor& place, const std::string& complaint) {
        if (!complaint.empty()) place.fail(complaint);
    }

    TextCursor text_;
    std::string name_;
    PlyHeader header_;
    SkeletonBuilder builder_;
    std::vector<double> row_;
};

}  // namespace

std::string write_ply_edges(const SkeletonGraph& graph, const std::string& origin) {
    std::string text = header_begin(origin, "curve skeleton: a vertex for each node, model units");
    text += fmt::format(
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "property double radius\nproperty double volume\nproperty uint solid\n"
        "element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n",
        graph.nodes.size(), graph.edges.size());
    for (const SkeletonGraph::Node& node : graph.nodes) {
        text += fmt::format("{} {} {} {} {} {}\n", node.position.x, node.position.y,
                            node.position.z, node.radius, node.volume, node.solid);
    }
    for (const SkeletonGraph::Edge& edge : graph.edges)
        text += fmt::format("{} {}\n", edge.source, edge.target);
    return text;
}

std::string write_ply_tubes(const SkeletonGraph& graph, const std::string& origin) {
    const TubeSurface tubes = tube_surface(graph);
    std::string text = header_begin(
        origin, "curve skeleton, its branches as tubes; node: that a vertex lies around");
    text += fmt::format(
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "property uint node\nelement face {}\nproperty list uchar int vertex_indices\n"
        "end_header\n",
        tubes.positions.size(), tubes.triangles.size());
    for (std::size_t i = 0; i < tubes.positions.size(); ++i) {
        const DVec3& p = tubes.positions[i];
        text += fmt::format("{} {} {} {}\n", p.x, p.y, p.z, tubes.node[i]);
    }
    for (const Triangle& t : tubes.triangles) text += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
    return text;
}

SkeletonFile read_ply_edges(std::string_view bytes, const std::string& name) {
    return PlyEdgesReader(bytes, name).read();
}

}  // namespace zskel
