// VTK's XML PolyData in ascii: a point for each node, a polyline for each branch, a vertex for each
// lone node. The radii have the name that VMTK gives them on centerlines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <pugixml.hpp>
#include <vector>

#include "zskel/core/error.h"
#include "zskel/io/format_io.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

constexpr const char* kRadius = "MaximumInscribedSphereRadius";
constexpr const char* kVolume = "NodeVolume";
constexpr const char* kSolid = "Solid";

template <typename T>
constexpr std::string_view type_name();
template <>
constexpr std::string_view type_name<double>() {
    return "Float64";
}
template <>
constexpr std::string_view type_name<std::int64_t>() {
    return "Int64";
}

template <typename T>
std::string array(std::string_view name, const std::vector<T>& values, int components = 1) {
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n"
        "</DataArray>\n",
        type_name<T>(), name, components, fmt::join(values, " "));
}

/// Cells as VTK keeps them: the points of all, and behind which of them each cell ends.
struct Cells {
    std::vector<std::int64_t> points;
    std::vector<std::int64_t> ends;

    void add(const std::vector<std::uint32_t>& nodes) {
        points.insert(points.end(), nodes.begin(), nodes.end());
        ends.push_back(static_cast<std::int64_t>(points.size()));
    }
    std::string text(std::string_view element) const {
        return fmt::format("<{0}>\n{1}{2}</{0}>\n", element, array("connectivity", points),
                           array("offsets", ends));
    }
};

std::string point_text(const SkeletonGraph& graph) {
    std::vector<double> places;
    std::vector<double> radii;
    std::vector<double> volumes;
    std::vector<std::int64_t> solids;
    for (const SkeletonGraph::Node& node : graph.nodes) {
        for (int axis = 0; axis < 3; ++axis) places.push_back(node.position[axis]);
        radii.push_back(node.radius);
        volumes.push_back(node.volume);
        solids.push_back(node.solid);
    }
    return fmt::format("<PointData Scalars=\"{}\">\n{}{}{}</PointData>\n<Points>\n{}</Points>\n",
                       kRadius, array(kRadius, radii), array(kVolume, volumes),
                       array(kSolid, solids), array("Points", places, 3));
}

// Vertices come before lines, here as in VTK's count of cells; a vertex is no branch.
std::string cell_text(const SkeletonGraph& graph, Cells& vertices, Cells& lines) {
    std::vector<std::int64_t> ids;
    std::vector<double> lengths;
    std::vector<double> mean_radii;
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    for (std::uint32_t n = 0; n < degrees.size(); ++n) {
        if (degrees[n] > 0) continue;
        vertices.add({n});
        ids.push_back(-1);
        lengths.push_back(0.0);
        mean_radii.push_back(graph.nodes[n].radius);
    }
    for (const Branch& branch : find_branches(graph)) {
        ids.push_back(static_cast<std::int64_t>(lines.ends.size()));
        lines.add(branch.nodes);
        lengths.push_back(branch.length);
        mean_radii.push_back(branch.mean_radius);
    }
    return fmt::format("<CellData>\n{}{}{}</CellData>\n{}{}", array("BranchId", ids),
                       array("BranchLength", lengths), array("BranchMeanRadius", mean_radii),
                       vertices.text("Verts"), lines.text("Lines"));
}

// VTK writes the strings of an ascii file as the codes of their bytes, each with a zero behind it.
std::string origin_text(const std::string& origin) {
    std::string codes;
    for (const char c : origin) codes += fmt::format("{} ", static_cast<int>(c));
    return fmt::format(
        "<FieldData>\n<DataArray type=\"String\" Name=\"Origin\" NumberOfTuples=\"1\" "
        "format=\"ascii\">\n{}0\n</DataArray>\n</FieldData>\n",
        codes);
}

class VtpReader {
  public:
    VtpReader(std::string_view bytes, const std::string& name) : name_(name) {
        const pugi::xml_parse_result result = document_.load_buffer(bytes.data(), bytes.size());
        if (!result) {
            throw InputError(
                fmt::format("{}: byte {}: {}", name, result.offset, result.description()));
        }
    }

    SkeletonFile read() {
        const pugi::xml_node data = document_.child("VTKFile").child("PolyData");
        const pugi::xml_node piece = data.child("Piece");
        if (!piece) fail("no VTKFile with PolyData and a Piece");
        if (piece.next_sibling("Piece")) fail("more than one Piece");
        const bool has_radii = read_points(piece);
        read_lines(piece);
        return builder_.finish(has_radii, name_);
    }

  private:
    [[noreturn]] void fail(std::string_view text) const {
        throw InputError(fmt::format("{}: {}", name_, text));
    }

    static pugi::xml_node named(const pugi::xml_node& parent, const char* array) {
        return parent.find_child_by_attribute("DataArray", "Name", array);
    }

    /// Lines in messages are those of the array.
    std::vector<double> numbers(const pugi::xml_node& array) const {
        const std::string label = fmt::format("{}: DataArray {}", name_,
                                              quoted(array.attribute("Name").as_string("Points")));
        if (std::string_view(array.attribute("format").as_string()) != "ascii")
            throw InputError(fmt::format("{}: only ascii arrays are read", label));
        TextCursor text(array.child_value(), label);
        std::vector<double> values;
        while (text.to_content()) values.push_back(text.finite_number("value"));
        return values;
    }

    std::vector<double> point_numbers(const pugi::xml_node& piece, const char* array,
                                      std::size_t count) const {
        const pugi::xml_node found = named(piece.child("PointData"), array);
        if (!found) return std::vector<double>(count, 0.0);
        std::vector<double> values = numbers(found);
        if (values.size() != count)
            fail(fmt::format("{} values of {} for {} points", values.size(), array, count));
        return values;
    }

    bool read_points(const pugi::xml_node& piece) {
        const pugi::xml_node array = piece.child("Points").child("DataArray");
        if (!array) fail("no Points");
        const std::vector<double> places = numbers(array);
        if (places.size() % 3 != 0)
            fail(fmt::format("{} coordinates of points, not three each", places.size()));
        const std::size_t count = places.size() / 3;
        const std::vector<double> radii = point_numbers(piece, kRadius, count);
        const std::vector<double> volumes = point_numbers(piece, kVolume, count);
        const std::vector<double> solids = point_numbers(piece, kSolid, count);
        for (std::size_t i = 0; i < count; ++i) {
            if (!(solids[i] >= 0.0 && solids[i] < kNone)) fail(fmt::format("solid {}", solids[i]));
            const std::string complaint =
                builder_.add_node({{places[3 * i], places[3 * i + 1], places[3 * i + 2]},
                                   radii[i],
                                   static_cast<std::uint32_t>(solids[i]),
                                   volumes[i]});
            if (!complaint.empty()) fail(fmt::format("point {}: {}", i, complaint));
        }
        return !named(piece.child("PointData"), kRadius).empty();
    }

    std::vector<double> line_numbers(const pugi::xml_node& lines, const char* array) const {
        const pugi::xml_node found = named(lines, array);
        if (!found) fail(fmt::format("Lines without a DataArray {}", array));
        std::vector<double> values = numbers(found);
        for (const double value : values) {
            if (!(value >= 0.0 && value < kNone && std::floor(value) == value))
                fail(fmt::format("{} in the {} of Lines; expected whole numbers from 0 up", value,
                                 array));
        }
        return values;
    }

    void read_lines(const pugi::xml_node& piece) {
        const pugi::xml_node lines = piece.child("Lines");
        if (lines.empty()) return;
        const std::vector<double> points = line_numbers(lines, "connectivity");
        const std::vector<double> ends = line_numbers(lines, "offsets");
        double begin = 0.0;
        for (std::size_t line = 0; line < ends.size(); ++line) {
            if (!(ends[line] >= begin && ends[line] <= static_cast<double>(points.size())))
                fail(fmt::format("line {} ends behind {} of {} points", line, ends[line],
                                 points.size()));
            const auto past = static_cast<std::size_t>(ends[line]);
            for (auto i = static_cast<std::size_t>(begin) + 1; i < past; ++i) {
                const std::string complaint = builder_.add_edge(
                    static_cast<std::int64_t>(points[i - 1]), static_cast<std::int64_t>(points[i]));
                if (!complaint.empty()) fail(fmt::format("line {}: {}", line, complaint));
            }
            begin = ends[line];
        }
    }

    pugi::xml_document document_;
    std::string name_;
    SkeletonBuilder builder_;
};

}  // namespace

std::string write_vtp(const SkeletonGraph& graph, const std::string& origin) {
    Cells vertices;
    Cells lines;
    const std::string cells = cell_text(graph, vertices, lines);
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<PolyData>\n{}<Piece NumberOfPoints=\"{}\" "
        "NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
        "{}{}</Piece>\n</PolyData>\n</VTKFile>\n",
        origin_text(origin), graph.nodes.size(), vertices.ends.size(), lines.ends.size(),
        point_text(graph), cells);
}

SkeletonFile read_vtp(std::string_view bytes, const std::string& name) {
    return VtpReader(bytes, name).read();
}

}  // namespace zskel
