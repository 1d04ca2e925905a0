#include "node_maps.h"

#include "zskel/visibility/cube_map.h"

namespace zskel::cli {

CLI::Option* add_map_px_option(CLI::App& command, int& map_px) {
    return command
        .add_option("--map-px", map_px, "Texels along a face of the nodes' visibility maps")
        ->capture_default_str()
        ->check(CLI::Range(kMinFacePx, kMaxFacePx));
}

VisibilityMaps maps_of(const Mesh& mesh, const SkeletonGraph& graph, BackendOptions backend,
                       int map_px) {
    backend.face_px = map_px;
    return look_from_nodes(mesh, graph, *open_backend(backend));
}

}  // namespace zskel::cli
