#include <fmt/format.h>

#include <algorithm>

#include "zskel/core/edges.h"
#include "zskel/skeleton/connect.h"
#include "zskel/skeleton/method.h"
#include "zskel/skeleton/network.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

// A mean of end points may lie outside; the end point nearest to it does not.
void center_on_members(Clusters& clusters, std::span<const Vec3> ends) {
    std::vector<std::uint32_t> best(clusters.centers.size(), kNone);
    for (std::uint32_t p = 0; p < ends.size(); ++p) {
        const std::uint32_t c = clusters.of_point[p];
        const auto distance = [&](std::uint32_t q) {
            return glm::distance(ends[q], clusters.centers[c]);
        };
        if (best[c] == kNone || distance(p) < distance(best[c])) best[c] = p;
    }
    for (std::size_t c = 0; c < best.size(); ++c) clusters.centers[c] = ends[best[c]];
}

// Numbers the nodes that are left, and turns links into edges.
void flatten(const CurveGraph& graph, const SeedSpread& spread, SolidSkeleton& out) {
    std::vector<std::uint32_t> number(graph.nodes.size(), kNone);
    std::vector<std::uint32_t> seed_node(spread.vertices.size(), kNone);
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        const CurveGraph::Node& node = graph.nodes[n];
        if (node.is_removed) continue;
        number[n] = static_cast<std::uint32_t>(out.nodes.size());
        out.nodes.push_back(node.position);
        out.radii.push_back(node.radius);
        for (const std::uint32_t s : node.seeds) seed_node[s] = number[n];
    }
    for (const std::uint32_t seed : spread.seed_of) out.vertex_node.push_back(seed_node[seed]);
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        if (graph.nodes[n].is_removed) continue;
        for (const std::uint32_t other : graph.nodes[n].links) {
            if (number[n] < number[other]) out.edges.emplace_back(number[n], number[other]);
        }
    }
    std::sort(out.edges.begin(), out.edges.end(), edge_before);
}

}  // namespace

SolidSkeleton extract_by_newton(const Surface& surface, bool is_closed, VisibilitySource& source,
                                const NewtonMethodOptions& options,
                                const MethodProgress& progress) {
    SolidSkeleton out;
    progress.begin("seeds");
    const SurfaceQuery query(surface);
    const std::vector<float> thickness = vertex_thickness(surface, query);
    const std::vector<Vec3> inner = inner_points(surface, thickness, options.seeds);
    const SeedSpread spread = spread_seeds(surface, thickness, options.spread);
    for (const std::uint32_t v : spread.vertices) out.seeds.push_back({inner[v], v});
    progress.begin("settle");
    out.settled = settle_seeds_newton(source, out.seeds, options.steps, progress.report);
    std::vector<Vec3> ends;
    for (const SettledSeed& seed : out.settled) ends.push_back(seed.position);

    progress.begin("handles");
    std::optional<HandleClasses> handles;
    if (is_closed) {
        std::string why;
        handles = find_handles(surface, inner, why);
        if (!handles)
            out.warnings.push_back(
                fmt::format("cycles cannot be told from wrong connections: {}", why));
    }
    out.expected_cycles = handles ? handles->genus : 0;

    progress.begin("connect");
    // Pairs of seeds whose patches meet.
    const std::vector<glm::uvec2> links = connect_clusters(spread.seed_of, surface.edges);
    std::vector<float> radii;
    std::vector<float> ranges;
    for (const Vec3& end : ends) {
        radii.push_back(query.nearest(end).distance);
        const double wanted = options.cluster_radii * static_cast<double>(radii.back());
        ranges.push_back(static_cast<float>(
            std::clamp(wanted, options.min_cluster_world, options.max_cluster_world)));
    }
    const std::vector<Shortcut> shortcuts = find_shortcuts(ends, links, radii, ranges);
    std::vector<glm::uvec2> joints = links;
    for (const Shortcut& s : shortcuts) joints.emplace_back(s.walk.front(), s.walk.back());
    std::vector<Vec3> seed_points;
    for (const std::uint32_t v : spread.vertices) seed_points.push_back(surface.positions[v]);
    CurveGraph graph;
    for (int attempt = 0;; ++attempt) {
        Clusters clusters = cluster_minima(ends, joints, ranges);
        center_on_members(clusters, ends);
        const ClusterContext context{surface, query, spread,    out.settled,
                                     inner,   links, shortcuts, clusters};
        const ClusterNetwork network = connect_network(context, handles);
        if (!network.has_all_cycles && attempt < options.max_retries) {
            for (float& range : ranges) range *= 0.5f;
            continue;
        }
        if (!network.has_all_cycles)
            out.warnings.emplace_back("a handle is smaller than the clusters: a cycle is missing");
        const Limbs limbs = grow_limbs(context, network, options.limbs);
        const auto unfree =
            std::count_if(limbs.connections.begin(), limbs.connections.end(),
                          [&](std::uint32_t i) { return !network.connections[i].is_inside; });
        if (unfree > 0)
            out.warnings.push_back(fmt::format("{} connections could not be laid inside", unfree));
        out.limbs = limbs.limbs;
        out.rejected_limbs = limbs.rejected;
        graph = build_graph(context, network.connections, limbs);
        break;
    }
    progress.begin("refine");
    out.refine = refine_graph(graph, seed_points, query, options.refine);
    flatten(graph, spread, out);
    out.forest_edges = out.nodes.size() - 1;
    return out;
}

}  // namespace zskel
