#include "skeleton_output.h"

#include <fmt/format.h>

#include "zskel/core/error.h"

namespace zskel::cli {

void add_output_options(CLI::App& command, SkeletonOutput& output) {
    command
        .add_option("-o,--output", output.path,
                    "Where the skeleton goes; - writes standard output. The extension says the "
                    "form: .json .graphml .swc .obj .ply .vtp .polylines.txt .gltf .glb")
        ->capture_default_str();
    command
        .add_option("--format", output.format,
                    "The form, whatever the output's name: json, node-link, graphml, swc, obj, "
                    "ply, vtp, polylines, gltf or glb")
        ->type_name("NAME");
    command.add_flag("--node-link", output.node_link, "Write JSON as NetworkX reads it");
    command.add_flag("--tubes", output.tubes,
                     "Write a surface as thick as the radii, for viewers that show no lines "
                     "(obj, ply, gltf, glb)");
}

SkeletonFormat format_of(const SkeletonOutput& output) {
    if (output.path.empty()) throw UsageError("--output needs a name, or - for standard output");
    SkeletonFormat format = output.format.empty() ? skeleton_format_of_path(output.path)
                                                  : parse_skeleton_format(output.format);
    if (output.node_link) {
        if (format != SkeletonFormat::Json && format != SkeletonFormat::NodeLink) {
            throw UsageError(
                fmt::format("--node-link goes with JSON, not with {}", info_of(format).name));
        }
        format = SkeletonFormat::NodeLink;
    }
    if (output.tubes && !info_of(format).has_tubes) {
        throw UsageError(fmt::format("--tubes goes with obj, ply, gltf and glb, not with {}",
                                     info_of(format).name));
    }
    return format;
}

}  // namespace zskel::cli
