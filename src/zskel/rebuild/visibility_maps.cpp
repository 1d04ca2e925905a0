// The maps that the paper would keep at its nodes (its section 6): what a node sees is all that is
// needed to recall the surface round it.
#include "zskel/rebuild/visibility_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "zskel/core/error.h"
#include "zskel/mesh/solid.h"

namespace zskel {
namespace {

constexpr std::size_t kBatch = 256;  // eyes rendered at once

void look_in_solid(const Surface& surface, std::span<NodeMap> nodes, Backend& backend,
                   int& face_px) {
    const std::unique_ptr<VisibilitySource> source = backend.prepare(surface);
    face_px = source->directions().face_px;
    if (face_px == 0) throw UsageError("visibility maps are cube maps: leave --rays out");
    const Similarity& world = surface.world_from_model;
    MapBatch maps;
    for (std::size_t begin = 0; begin < nodes.size(); begin += kBatch) {
        const std::span<NodeMap> batch =
            nodes.subspan(begin, std::min(kBatch, nodes.size() - begin));
        std::vector<Vec3> eyes;
        std::transform(batch.begin(), batch.end(), std::back_inserter(eyes),
                       [&](const NodeMap& node) { return world.to_world(node.eye); });
        source->render(eyes, maps);
        for (std::size_t i = 0; i < batch.size(); ++i) {
            for (const float d : maps.view(i).distance)
                batch[i].distance.push_back(static_cast<float>(world.length_to_model(d)));
        }
    }
}

}  // namespace

VisibilityMaps look_from_nodes(const Mesh& mesh, const SkeletonGraph& graph, Backend& backend) {
    const std::vector<Solid> solids = split_solids(prepare_surface(mesh, WorldSize::Spread));
    VisibilityMaps out;
    // Solids one after the other, then back into the order of the nodes.
    std::vector<std::size_t> order(graph.nodes.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return graph.nodes[a].solid < graph.nodes[b].solid;
    });
    std::vector<NodeMap> sorted;
    for (const std::size_t n : order)
        sorted.push_back({graph.nodes[n].position, graph.nodes[n].solid, {}});
    for (auto begin = sorted.begin(); begin != sorted.end();) {
        const std::uint32_t solid = begin->solid;
        if (solid >= solids.size()) {
            throw InputError(fmt::format("{}: has {} solids, the skeleton speaks of number {}",
                                         mesh.name, solids.size(), solid));
        }
        const auto end = std::find_if(begin, sorted.end(),
                                      [&](const NodeMap& node) { return node.solid != solid; });
        look_in_solid(solids[solid].surface, std::span(begin, end), backend, out.face_px);
        begin = end;
    }
    out.nodes.resize(sorted.size());
    for (std::size_t i = 0; i < order.size(); ++i) out.nodes[order[i]] = std::move(sorted[i]);
    return out;
}

}  // namespace zskel
