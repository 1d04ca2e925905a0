#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "zskel/skeleton/graph.h"

namespace zskel {

/// The forms in which a skeleton is written.
enum class SkeletonFormat {
    Json,       ///< ours: nodes, edges, branches, the node of every input vertex
    NodeLink,   ///< JSON as NetworkX reads it, with its old key `links` and its new one `edges`
    GraphMl,    ///< nodes with x, y, z, radius, volume and solid; edges with their length
    Swc,        ///< trees; cycles are cut, and the comments say where
    ObjLines,   ///< `v` and `l`; no radii
    Ply,        ///< ascii, elements vertex and edge
    Vtp,        ///< VTK PolyData, a polyline for each branch, VMTK's name for the radii
    Polylines,  ///< CGAL's .polylines.txt, a line for each branch; no radii
    Gltf,       ///< lines, the radius as attribute _RADIUS, its bytes within the JSON
    Glb,        ///< the same as one binary file
};

struct SkeletonFormatInfo {
    SkeletonFormat format = SkeletonFormat::Json;
    std::string_view name;       ///< as `--format` takes it
    std::string_view extension;  ///< what a file's name ends with
    bool keeps_radii = true;
    bool is_readable = true;
    bool has_tubes = false;  ///< can hold a surface in place of lines
};

/// Every format once, in the order of the enumeration.
std::span<const SkeletonFormatInfo> skeleton_formats();
const SkeletonFormatInfo& info_of(SkeletonFormat format);

/// The format of that name. @throws UsageError that lists them.
SkeletonFormat parse_skeleton_format(std::string_view name);

/// The format that a path's extension says; JSON where it has none ("-", devices, pipes).
/// @throws UsageError for an extension that is no format's.
SkeletonFormat skeleton_format_of_path(const std::string& path);

struct SkeletonWriteOptions {
    bool tubes = false;   ///< a closed surface as thick as the radii say; see `has_tubes`
    std::string command;  ///< what made the skeleton, for the file's comment; may be empty
};

/// The bytes of a skeleton's file, in model units. Same graph and options, same bytes.
/// @throws UsageError when tubes are asked of a format that has none.
std::string write_skeleton(const SkeletonGraph& graph, SkeletonFormat format,
                           const SkeletonWriteOptions& options = {});

/// CGAL's second file: for every vertex of the mesh that has a node a segment from that node to
/// it, `2 x y z x y z`. @param positions  of the mesh whose vertices `graph.vertex_node` names.
std::string write_correspondence(const SkeletonGraph& graph, std::span<const DVec3> positions);

/// A skeleton that was read. What its format lacks is 0 (radius, volume, solid) or empty.
struct SkeletonFile {
    SkeletonGraph graph;
    bool has_radii = true;
};

/// Reads a skeleton. Both forms of JSON are told apart by their content.
/// @param path    a file, or "-" for standard input.
/// @param format  by default the one that the path's extension says.
/// @throws InputError  naming file, line or element, and value, on anything malformed; UsageError
/// for a format that is only written.
SkeletonFile read_skeleton(const std::string& path, std::optional<SkeletonFormat> format = {});

/// The same from bytes already in memory; `name` stands in messages.
SkeletonFile parse_skeleton(std::string_view bytes, SkeletonFormat format, const std::string& name);

}  // namespace zskel
