// GraphML after U. Brandes et al., "GraphML Progress Report", 2001. Attributes go by their names;
// the keys' and the nodes' ids may be any.
#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <pugixml.hpp>
#include <unordered_map>

#include "zskel/core/error.h"
#include "zskel/io/format_io.h"
#include "zskel/io/markup.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

constexpr std::string_view kHead =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="x" for="node" attr.name="x" attr.type="double"/>
<key id="y" for="node" attr.name="y" attr.type="double"/>
<key id="z" for="node" attr.name="z" attr.type="double"/>
<key id="radius" for="node" attr.name="radius" attr.type="double"/>
<key id="volume" for="node" attr.name="volume" attr.type="double"/>
<key id="solid" for="node" attr.name="solid" attr.type="long"/>
<key id="length" for="edge" attr.name="length" attr.type="double"/>
<key id="origin" for="graph" attr.name="origin" attr.type="string"/>
)";

class GraphmlReader {
  public:
    GraphmlReader(std::string_view bytes, const std::string& name) : name_(name) {
        const pugi::xml_parse_result result = document_.load_buffer(bytes.data(), bytes.size());
        if (!result) {
            throw InputError(
                fmt::format("{}: byte {}: {}", name, result.offset, result.description()));
        }
    }

    SkeletonFile read() {
        const pugi::xml_node root = document_.child("graphml");
        const pugi::xml_node graph = root.child("graph");
        if (!graph) fail("no graphml with a graph");
        for (const pugi::xml_node& key : root.children("key")) {
            if (std::string_view(key.attribute("for").as_string()) != "node") continue;
            keys_.emplace(key.attribute("attr.name").as_string(), key.attribute("id").as_string());
        }
        for (const char* axis : {"x", "y", "z"})
            if (!keys_.contains(axis)) fail(fmt::format("no key for a node's {}", axis));
        const bool has_radii = keys_.contains("radius");
        for (const pugi::xml_node& node : graph.children("node")) read_node(node);
        for (const pugi::xml_node& edge : graph.children("edge")) read_edge(edge);
        return builder_.finish(has_radii, name_);
    }

  private:
    [[noreturn]] void fail(std::string_view text) const {
        throw InputError(fmt::format("{}: {}", name_, text));
    }

    /// A node's attribute; nothing when the file declares no such key.
    std::optional<double> attribute(const pugi::xml_node& node, const std::string& what) const {
        const auto key = keys_.find(what);
        if (key == keys_.end()) return std::nullopt;
        const pugi::xml_node data =
            node.find_child_by_attribute("data", "key", key->second.c_str());
        const std::string_view text = data.text().get();
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size()) {
            fail(fmt::format("node {}: {} {} is not a number",
                             zskel::quoted(node.attribute("id").as_string()), what,
                             zskel::quoted(text)));
        }
        return value;
    }

    void read_node(const pugi::xml_node& element) {
        const std::string id = element.attribute("id").as_string();
        SkeletonGraph::Node node;
        node.position = {*attribute(element, "x"), *attribute(element, "y"),
                         *attribute(element, "z")};
        node.radius = attribute(element, "radius").value_or(0.0);
        node.volume = attribute(element, "volume").value_or(0.0);
        const double solid = attribute(element, "solid").value_or(0.0);
        if (!(solid >= 0.0 && solid < kNone))
            fail(fmt::format("node {}: solid {}", zskel::quoted(id), solid));
        node.solid = static_cast<std::uint32_t>(solid);
        if (!numbers_.try_emplace(id, builder_.node_count()).second)
            fail(fmt::format("a second node {}", zskel::quoted(id)));
        const std::string complaint = builder_.add_node(node);
        if (!complaint.empty()) fail(fmt::format("node {}: {}", zskel::quoted(id), complaint));
    }

    void read_edge(const pugi::xml_node& element) {
        const std::string source = element.attribute("source").as_string();
        const std::string target = element.attribute("target").as_string();
        const std::string complaint = builder_.add_edge(number_of(source), number_of(target));
        if (!complaint.empty())
            fail(fmt::format("edge from {} to {}: {}", zskel::quoted(source), zskel::quoted(target),
                             complaint));
    }

    std::int64_t number_of(const std::string& id) const {
        const auto found = numbers_.find(id);
        if (found == numbers_.end())
            fail(fmt::format("an edge to {}, which is no node", zskel::quoted(id)));
        return static_cast<std::int64_t>(found->second);
    }

    pugi::xml_document document_;
    std::string name_;
    SkeletonBuilder builder_;
    std::unordered_map<std::string, std::string> keys_;
    std::unordered_map<std::string, std::size_t> numbers_;
};

}  // namespace

std::string write_graphml(const SkeletonGraph& graph, const std::string& origin) {
    std::string text(kHead);
    text += fmt::format("<graph edgedefault=\"undirected\">\n<data key=\"origin\">{}</data>\n",
                        escaped_markup(origin));
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const SkeletonGraph::Node& node = graph.nodes[i];
        text += fmt::format(
            "<node id=\"{}\"><data key=\"x\">{}</data><data key=\"y\">{}</data>"
            "<data key=\"z\">{}</data><data key=\"radius\">{}</data>"
            "<data key=\"volume\">{}</data><data key=\"solid\">{}</data></node>\n",
            i, node.position.x, node.position.y, node.position.z, node.radius, node.volume,
            node.solid);
    }
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        const double length =
            glm::distance(graph.nodes[edge.source].position, graph.nodes[edge.target].position);
        text +=
            fmt::format("<edge source=\"{}\" target=\"{}\"><data key=\"length\">{}</data></edge>\n",
                        edge.source, edge.target, length);
    }
    return text + "</graph>\n</graphml>\n";
}

SkeletonFile read_graphml(std::string_view bytes, const std::string& name) {
    return GraphmlReader(bytes, name).read();
}

}  // namespace zskel
