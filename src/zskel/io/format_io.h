#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

#include "zskel/io/skeleton_formats.h"

namespace zskel {

// A writer and, where there is one, a reader for each format of skeleton_formats.h. `origin` is a
// line of printable ASCII that says what made the skeleton; `name` stands in messages. All readers
// throw InputError.

std::string write_graph_json(const SkeletonGraph& graph, const std::string& command);
std::string write_node_link(const SkeletonGraph& graph, const std::string& origin);
std::string write_graphml(const SkeletonGraph& graph, const std::string& origin);
std::string write_swc(const SkeletonGraph& graph, const std::string& origin);
std::string write_obj_lines(const SkeletonGraph& graph);
std::string write_obj_tubes(const SkeletonGraph& graph, const std::string& origin);
std::string write_ply_edges(const SkeletonGraph& graph, const std::string& origin);
std::string write_ply_tubes(const SkeletonGraph& graph, const std::string& origin);
std::string write_vtp(const SkeletonGraph& graph, const std::string& origin);
std::string write_polylines(const SkeletonGraph& graph);

enum class GltfContainer { Json, Binary };
std::string write_gltf_lines(const SkeletonGraph& graph, const std::string& origin,
                             GltfContainer container);
std::string write_gltf_tubes(const SkeletonGraph& graph, const std::string& origin,
                             GltfContainer container);

SkeletonFile read_skeleton_json(std::string_view bytes, const std::string& name);
SkeletonFile read_graphml(std::string_view bytes, const std::string& name);
SkeletonFile read_swc(std::string_view bytes, const std::string& name);
SkeletonFile read_obj_lines(std::string_view bytes, const std::string& name);
SkeletonFile read_ply_edges(std::string_view bytes, const std::string& name);
SkeletonFile read_vtp(std::string_view bytes, const std::string& name);
SkeletonFile read_polylines(std::string_view bytes, const std::string& name);

/// Collects what a reader finds. What cannot be is said in the text that comes back, for the
/// reader to add its place to; empty when all is well.
class SkeletonBuilder {
  public:
    std::string add_node(const SkeletonGraph::Node& node);

    /// Node numbers from 0; the nodes must be there already.
    std::string add_edge(std::int64_t a, std::int64_t b);

    std::size_t node_count() const { return file_.graph.nodes.size(); }

    /// The graph with its edges sorted. @throws InputError when there is no node.
    SkeletonFile finish(bool has_radii, const std::string& name);

  private:
    SkeletonFile file_;
    std::unordered_set<std::uint64_t> pairs_;
};

}  // namespace zskel
