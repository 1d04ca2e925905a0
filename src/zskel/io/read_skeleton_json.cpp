// Both forms of JSON: ours, where nodes are numbered, and NetworkX's node-link data, where anything
// may name a node.
#include <fmt/format.h>

#include <unordered_map>
#include <utility>

#include <nlohmann/json.hpp>

#include "zskel/core/error.h"
#include "zskel/io/format_io.h"
#include "zskel/io/json_place.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

using Place = JsonPlace;

void read_extras(const Place& entry, SkeletonGraph::Node& node) {
    if (entry.has("volume")) node.volume = entry.at("volume").number();
    if (entry.has("solid")) node.solid = entry.at("solid").count();
}

void read_vertex_node(const Place& list, SkeletonFile& file) {
    const auto nodes = static_cast<std::int64_t>(file.graph.nodes.size());
    for (std::size_t i = 0; i < list.array_size(); ++i) {
        const Place entry = list.at(i);
        const std::int64_t node = entry.integer();
        if (node < -1 || node >= nodes) entry.fail("a node's number, or -1 for none");
        file.graph.vertex_node.push_back(node < 0 ? kNone : static_cast<std::uint32_t>(node));
    }
}

SkeletonFile read_ours(const Place& root, const std::string& name) {
    if (root.at("format").value() != "zskel-skeleton") root.at("format").fail("\"zskel-skeleton\"");
    if (root.at("version").value() != 1) root.at("version").fail("1, which this program reads");
    SkeletonBuilder builder;
    const Place nodes = root.at("nodes");
    for (std::size_t i = 0; i < nodes.array_size(); ++i) {
        const Place entry = nodes.at(i);
        if (entry.at("id").integer() != static_cast<std::int64_t>(i))
            entry.at("id").fail("the node's place in the list");
        SkeletonGraph::Node node;
        node.position = entry.at("position").point();
        node.radius = entry.at("radius").number();
        node.is_open_end = entry.has("open_end");
        read_extras(entry, node);
        entry.check(builder.add_node(node));
    }
    const Place edges = root.at("edges");
    for (std::size_t i = 0; i < edges.array_size(); ++i) {
        const Place edge = edges.at(i);
        edge.check(builder.add_edge(edge.at("source").integer(), edge.at("target").integer()));
    }
    SkeletonFile file = builder.finish(true, name);
    if (root.has("vertex_node")) read_vertex_node(root.at("vertex_node"), file);
    return file;
}

using NodeNumbers = std::unordered_map<std::string, std::uint32_t>;

/// Reads the nodes and numbers them by their names. @return whether they have radii.
bool read_named_nodes(const Place& nodes, SkeletonBuilder& builder, NodeNumbers& numbers) {
    const bool has_radii = nodes.array_size() > 0 && nodes.at(std::size_t{0}).has("radius");
    for (std::size_t i = 0; i < nodes.array_size(); ++i) {
        const Place entry = nodes.at(i);
        SkeletonGraph::Node node;
        node.position = {entry.at("x").number(), entry.at("y").number(), entry.at("z").number()};
        if (has_radii) node.radius = entry.at("radius").number();
        if (!has_radii && entry.has("radius")) entry.check("a radius, but the first node has none");
        read_extras(entry, node);
        entry.check(builder.add_node(node));
        const std::string id = entry.at("id").value().dump();
        if (!numbers.try_emplace(id, static_cast<std::uint32_t>(i)).second)
            entry.at("id").fail("new: another node has it");
    }
    return has_radii;
}

std::uint32_t number_of(const Place& end, const NodeNumbers& numbers) {
    const auto found = numbers.find(end.value().dump());
    if (found == numbers.end()) end.fail("the id of a node");
    return found->second;
}

SkeletonFile read_node_link(const Place& root, const std::string& name) {
    SkeletonBuilder builder;
    NodeNumbers numbers;
    const bool has_radii = read_named_nodes(root.at("nodes"), builder, numbers);
    if (root.has("links") && root.has("edges") &&
        root.at("links").value() != root.at("edges").value())
        root.check("links and edges differ, and only one can be meant");
    const Place edges = root.at(root.has("edges") ? "edges" : "links");
    for (std::size_t i = 0; i < edges.array_size(); ++i) {
        const Place edge = edges.at(i);
        edge.check(builder.add_edge(number_of(edge.at("source"), numbers),
                                    number_of(edge.at("target"), numbers)));
    }
    SkeletonFile file = builder.finish(has_radii, name);
    if (root.has("graph") && root.at("graph").has("vertex_node"))
        read_vertex_node(root.at("graph").at("vertex_node"), file);
    return file;
}

}  // namespace

SkeletonFile read_skeleton_json(std::string_view bytes, const std::string& name) {
    const nlohmann::json data = parse_json(bytes, name);
    const Place root(data, name);
    return root.has("format") ? read_ours(root, name) : read_node_link(root, name);
}

}  // namespace zskel
