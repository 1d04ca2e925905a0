#pragma once

#include "command.h"
#include "zskel/rebuild/visibility_maps.h"

namespace zskel::cli {

inline constexpr int kDefaultMapPx = 32;

/// Adds --map-px to a subcommand.
CLI::Option* add_map_px_option(CLI::App& command, int& map_px);

/// The maps of a skeleton's nodes by a backend of the kind that made it, with texels of their own.
VisibilityMaps maps_of(const Mesh& mesh, const SkeletonGraph& graph, BackendOptions backend,
                       int map_px);

}  // namespace zskel::cli
