#include "zskel/io/skeleton_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "zskel/core/error.h"
#include "zskel/core/input_file.h"
#include "zskel/io/format_io.h"

namespace zskel {
namespace {

constexpr std::array<SkeletonFormatInfo, 10> kFormats{{
    {SkeletonFormat::Json, "json", ".json"},
    {SkeletonFormat::NodeLink, "node-link", ".json"},
    {SkeletonFormat::GraphMl, "graphml", ".graphml"},
    {SkeletonFormat::Swc, "swc", ".swc"},
    {SkeletonFormat::ObjLines, "obj", ".obj", false, true, true},
    {SkeletonFormat::Ply, "ply", ".ply", true, true, true},
    {SkeletonFormat::Vtp, "vtp", ".vtp"},
    {SkeletonFormat::Polylines, "polylines", ".polylines.txt", false},
    {SkeletonFormat::Gltf, "gltf", ".gltf", true, false, true},
    {SkeletonFormat::Glb, "glb", ".glb", true, false, true},
}};

std::string all_names() {
    std::string text;
    for (const SkeletonFormatInfo& info : kFormats)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", info.name);
    return text;
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// A line of printable ASCII, whatever the command's arguments hold.
std::string origin_of(const std::string& command) {
    std::string program = "zskel " ZSKEL_VERSION;
    if (command.empty()) return program;
    const nlohmann::json text = command;
    return fmt::format("{}: {}", program,
                       text.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}

std::string write_tubes(const SkeletonGraph& graph, SkeletonFormat format,
                        const std::string& origin) {
    switch (format) {
        case SkeletonFormat::ObjLines:
            return write_obj_tubes(graph, origin);
        case SkeletonFormat::Ply:
            return write_ply_tubes(graph, origin);
        case SkeletonFormat::Gltf:
            return write_gltf_tubes(graph, origin, GltfContainer::Json);
        case SkeletonFormat::Glb:
            return write_gltf_tubes(graph, origin, GltfContainer::Binary);
        default:
            throw UsageError(fmt::format("tubes go with obj, ply, gltf and glb, not with {}",
                                         info_of(format).name));
    }
}

}  // namespace

std::span<const SkeletonFormatInfo> skeleton_formats() {
    return kFormats;
}

const SkeletonFormatInfo& info_of(SkeletonFormat format) {
    return kFormats[static_cast<std::size_t>(format)];
}

SkeletonFormat parse_skeleton_format(std::string_view name) {
    for (const SkeletonFormatInfo& info : kFormats) {
        if (info.name == name) return info.format;
    }
    throw UsageError(fmt::format("unknown format {}; there are {}", name, all_names()));
}

SkeletonFormat skeleton_format_of_path(const std::string& path) {
    const std::filesystem::path file = std::filesystem::path(path).filename();
    if (!file.has_extension() || file == "." || file == "..") return SkeletonFormat::Json;
    const std::string lower = lower_case(file.string());
    for (const SkeletonFormatInfo& info : kFormats) {
        if (lower.ends_with(info.extension)) return info.format;
    }
    throw UsageError(fmt::format("{}: no skeleton format has this extension; name one of {}", path,
                                 all_names()));
}

std::string write_skeleton(const SkeletonGraph& graph, SkeletonFormat format,
                           const SkeletonWriteOptions& options) {
    const std::string origin = origin_of(options.command);
    if (options.tubes) return write_tubes(graph, format, origin);
    switch (format) {
        case SkeletonFormat::Json:
            return write_graph_json(graph, options.command);
        case SkeletonFormat::NodeLink:
            return write_node_link(graph, origin);
        case SkeletonFormat::GraphMl:
            return write_graphml(graph, origin);
        case SkeletonFormat::Swc:
            return write_swc(graph, origin);
        case SkeletonFormat::ObjLines:
            return write_obj_lines(graph);
        case SkeletonFormat::Ply:
            return write_ply_edges(graph, origin);
        case SkeletonFormat::Vtp:
            return write_vtp(graph, origin);
        case SkeletonFormat::Polylines:
            return write_polylines(graph);
        case SkeletonFormat::Gltf:
            return write_gltf_lines(graph, origin, GltfContainer::Json);
        case SkeletonFormat::Glb:
            return write_gltf_lines(graph, origin, GltfContainer::Binary);
    }
    return {};
}

SkeletonFile read_skeleton(const std::string& path, std::optional<SkeletonFormat> format) {
    const SkeletonFormat taken = format ? *format : skeleton_format_of_path(path);
    return parse_skeleton(read_input_file(path, "a skeleton").text(), taken, path);
}

SkeletonFile parse_skeleton(std::string_view bytes, SkeletonFormat format,
                            const std::string& name) {
    switch (format) {
        case SkeletonFormat::Json:
        case SkeletonFormat::NodeLink:
            return read_skeleton_json(bytes, name);
        case SkeletonFormat::GraphMl:
            return read_graphml(bytes, name);
        case SkeletonFormat::Swc:
            return read_swc(bytes, name);
        case SkeletonFormat::ObjLines:
            return read_obj_lines(bytes, name);
        case SkeletonFormat::Ply:
            return read_ply_edges(bytes, name);
        case SkeletonFormat::Vtp:
            return read_vtp(bytes, name);
        case SkeletonFormat::Polylines:
            return read_polylines(bytes, name);
        case SkeletonFormat::Gltf:
        case SkeletonFormat::Glb:
            break;
    }
    throw UsageError(
        fmt::format("{}: {} is only written, not read: it keeps 32-bit numbers; keep the JSON",
                    name, info_of(format).name));
}

std::string SkeletonBuilder::add_node(const SkeletonGraph::Node& node) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(node.position[axis]))
            return fmt::format("coordinate {} is not finite", "xyz"[axis]);
    }
    if (!std::isfinite(node.radius) || node.radius < 0.0)
        return fmt::format("radius {}; expected a finite number from 0 up", node.radius);
    if (!std::isfinite(node.volume)) return "the volume is not finite";
    file_.graph.nodes.push_back(node);
    return {};
}

std::string SkeletonBuilder::add_edge(std::int64_t a, std::int64_t b) {
    const auto count = static_cast<std::int64_t>(node_count());
    for (const std::int64_t end : {a, b}) {
        if (end < 0 || end >= count)
            return fmt::format("an edge to node {}, counted from 0, of {}", end, count);
    }
    if (a == b) return "an edge from a node to itself";
    const auto source = static_cast<std::uint32_t>(std::min(a, b));
    const auto target = static_cast<std::uint32_t>(std::max(a, b));
    if (!pairs_.insert(std::uint64_t{source} << 32 | target).second)
        return "an edge that was there already";
    file_.graph.edges.push_back({source, target});
    return {};
}

SkeletonFile SkeletonBuilder::finish(bool has_radii, const std::string& name) {
    if (node_count() == 0) throw InputError(fmt::format("{}: no nodes; expected a skeleton", name));
    file_.has_radii = has_radii;
    std::sort(file_.graph.edges.begin(), file_.graph.edges.end(),
              [](const SkeletonGraph::Edge& l, const SkeletonGraph::Edge& r) {
                  return l.source != r.source ? l.source < r.source : l.target < r.target;
              });
    return std::move(file_);
}

}  // namespace zskel
