// glTF 2.0: one mesh, of lines with the radius as attribute _RADIUS, or of triangles. Without edges
// the nodes are points.
#include <vector>

#include "zskel/io/format_io.h"
#include "zskel/io/gltf_builder.h"
#include "zskel/io/tubes.h"

namespace zskel {
namespace {

using Json = GltfBuilder::Json;

Json empty_scene() {
    return {{"scenes", Json::array({Json::object()})}};
}

Json scene_of(const Json& primitive) {
    return {{"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}, {"name", "skeleton"}}}},
            {"meshes", {{{"primitives", {primitive}}}}}};
}

}  // namespace

std::string write_gltf_lines(const SkeletonGraph& graph, const std::string& origin,
                             GltfContainer container) {
    GltfBuilder builder;
    if (graph.nodes.empty()) return builder.finish(empty_scene(), origin, container);
    std::vector<DVec3> places;
    std::vector<float> radii;
    for (const SkeletonGraph::Node& node : graph.nodes) {
        places.push_back(node.position);
        radii.push_back(static_cast<float>(node.radius));
    }
    std::vector<std::uint32_t> ends;
    for (const SkeletonGraph::Edge& edge : graph.edges)
        ends.insert(ends.end(), {edge.source, edge.target});
    Json primitive{
        {"attributes",
         {{"POSITION", builder.add_positions(places)}, {"_RADIUS", builder.add_scalars(radii)}}},
        {"mode", static_cast<int>(ends.empty() ? GltfBuilder::PrimitiveMode::Points
                                               : GltfBuilder::PrimitiveMode::Lines)}};
    if (!ends.empty()) primitive["indices"] = builder.add_indices(ends);
    return builder.finish(scene_of(primitive), origin, container);
}

std::string write_gltf_tubes(const SkeletonGraph& graph, const std::string& origin,
                             GltfContainer container) {
    GltfBuilder builder;
    const TubeSurface tubes = tube_surface(graph);
    if (tubes.triangles.empty()) return builder.finish(empty_scene(), origin, container);
    std::vector<std::uint32_t> corners;
    for (const Triangle& t : tubes.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
    const Json primitive{{"attributes", {{"POSITION", builder.add_positions(tubes.positions)}}},
                         {"indices", builder.add_indices(corners)},
                         {"mode", static_cast<int>(GltfBuilder::PrimitiveMode::Triangles)}};
    return builder.finish(scene_of(primitive), origin, container);
}

}  // namespace zskel
