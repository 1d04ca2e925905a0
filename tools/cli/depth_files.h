#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "zskel/depth_probe.h"

namespace zskel::cli {

/// Writes a dump as EXR or PNG, by the path's extension. @throws UsageError for another one,
/// IoError.
void write_depth_file(const std::string& path, const DepthDump& dump);

/// Writes the maps along the paths of some vertices' seeds: FOLDER/vertex-000012-step-0003.exr. The
/// folder is made. Without vertices: eight, spread evenly over those of the mesh that have a face.
void write_trajectories(const std::string& folder, std::vector<std::uint32_t> vertices,
                        const Mesh& mesh, const ExtractOptions& options, Backend& backend);

}  // namespace zskel::cli
