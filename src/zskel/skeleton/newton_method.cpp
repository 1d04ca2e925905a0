#include <fmt/format.h>

#include <algorithm>

#include "zskel/core/edges.h"
#include "zskel/core/free_memory.h"
#include "zskel/core/parallel.h"
#include "zskel/skeleton/connect.h"
#include "zskel/skeleton/girth.h"
#include "zskel/skeleton/method.h"
#include "zskel/skeleton/network.h"
#include "zskel/skeleton/patches.h"
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

std::vector<float> radii_at(const SurfaceQuery& query, std::span<const Vec3> points) {
    std::vector<float> out(points.size());
    parallel_for(points.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out[i] = query.nearest(points[i]).distance;
    });
    return out;
}

HandleClasses handles_of(const Surface& surface, const std::vector<Vec3>& inner, bool is_closed,
                         const NewtonMethodOptions& options, SolidSkeleton& out) {
    if (!is_closed) return {};
    std::string why;
    const double min_radius = options.min_handle_model * surface.world_from_model.scale;
    std::optional<HandleClasses> handles = find_handles(surface, inner, min_radius, why);
    out.knows_cycles = handles.has_value();
    if (handles) return std::move(*handles);
    out.warnings.push_back(fmt::format(
        "the skeleton of a part is left without cycles, since they are not known: {}", why));
    return {};
}

// Halves the ranges in clusters that go round a handle all by themselves; false when none can be
// split.
bool split_rings(const ClusterNetwork& network, const Clusters& clusters,
                 std::vector<float>& ranges) {
    std::vector<std::uint32_t> sizes(clusters.centers.size(), 0);
    for (const std::uint32_t c : clusters.of_point) ++sizes[c];
    std::vector<bool> is_split(sizes.size(), false);
    for (const std::uint32_t i : network.spanning) {
        const Connection& c = network.connections[i];
        if (c.a == c.b && sizes[c.a] > 1) is_split[c.a] = true;
    }
    for (std::size_t s = 0; s < ranges.size(); ++s) {
        if (is_split[clusters.of_point[s]]) ranges[s] *= 0.5f;
    }
    return std::find(is_split.begin(), is_split.end(), true) != is_split.end();
}

// Numbers the nodes that are left, turns links into edges, and shares the vertices out.
void flatten(const CurveGraph& graph, const Surface& surface, const SeedSpread& spread,
             SolidSkeleton& out) {
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
    NodeLinks links(out.nodes.size());
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        if (graph.nodes[n].is_removed) continue;
        for (const std::uint32_t other : graph.nodes[n].links) {
            links[number[n]].push_back(number[other]);
            if (number[n] < number[other]) out.edges.emplace_back(number[n], number[other]);
        }
    }
    std::sort(out.edges.begin(), out.edges.end(), edge_before);
    std::vector<std::uint32_t> near;
    for (const std::uint32_t seed : spread.seed_of) near.push_back(seed_node[seed]);
    out.vertex_node = assign_patches(surface, out.nodes, links, near);
}

}  // namespace

NewtonMethodOptions for_sheets(NewtonMethodOptions options) {
    constexpr double kLeastLimb = 0.3;
    options.steps.max_steps = 0;
    options.limbs.least_world = std::max(options.limbs.least_world, kLeastLimb);
    options.refine.min_spacing_world = options.refine.max_spacing_world;
    return options;
}

SolidSkeleton extract_by_newton(
    const Surface& surface, const SurfaceQuery& query, bool is_closed,
    const std::function<std::unique_ptr<VisibilitySource>()>& make_source,
    const NewtonMethodOptions& options, const MethodProgress& progress) {
    SolidSkeleton out;
    progress.begin("seeds");
    const std::vector<float> thickness = vertex_thickness(surface, query);
    const std::vector<Vec3> starts = inner_points(surface, thickness, options.seeds);
    std::vector<Vec3> inner;
    SeedSpread spread;
    std::unique_ptr<VisibilitySource> source;
    // One front after the other is work for one thread.
    parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
        if (begin == 0) spread = spread_seeds(surface, thickness, options.spread);
        if (end == 2) {
            source = make_source();
            // What the first look has to make ready, of a GPU's too.
            EyeRecord first;
            source->look(std::span(starts).first(1), {&first, 1});
            inner = walkable_points(surface, query, starts);
        }
    });
    for (const std::uint32_t v : spread.vertices) out.seeds.push_back({starts[v], v});
    out.seed_spacing_thickness = spread.spacing_thickness;
    out.seed_end = spread.end;
    progress.begin("settle");
    out.settled = settle_seeds_newton(*source, out.seeds, options.steps, progress.report);
    // On a large mesh what it holds is a fifth of all memory.
    source.reset();
    constexpr std::size_t kLarge = 100000;
    if (surface.triangles.size() > kLarge) return_free_memory();
    std::vector<Vec3> ends;
    for (const SettledSeed& seed : out.settled) ends.push_back(seed.position);

    progress.begin("handles");
    const HandleClasses handles = handles_of(surface, inner, is_closed, options, out);
    out.expected_cycles = handles.cycles();
    out.ignored_handles = handles.ignored;

    progress.begin("connect");
    // Pairs of seeds whose patches meet.
    const std::vector<glm::uvec2> links = connect_clusters(spread.seed_of, surface.edges);
    const std::vector<float> radii = radii_at(query, ends);
    std::vector<float> ranges;
    for (const float radius : radii) {
        const double wanted = options.cluster_radii * static_cast<double>(radius);
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
        const std::vector<float> girths = girths_at(query, clusters.centers);
        const ClusterContext context{surface, query,     spread,   out.settled, inner,
                                     links,   shortcuts, clusters, girths,      is_closed};
        const ClusterNetwork network = connect_network(context, handles);
        if (attempt < options.max_retries && split_rings(network, clusters, ranges)) continue;
        if (!network.has_all_cycles)
            out.warnings.emplace_back("a cycle is missing: no way for it was found inside");
        if (!network.is_core_laid)
            out.warnings.emplace_back("not all cycles could be laid along the middle of the solid");
        const Limbs limbs = grow_limbs(context, network, options.limbs);
        const auto unfree = std::ranges::count(limbs.connections, false, &Connection::is_inside);
        if (unfree > 0)
            out.warnings.push_back(fmt::format("{} connections could not be laid inside", unfree));
        out.limbs = limbs.limbs;
        out.rejected_limbs = limbs.rejected;
        graph = build_graph(context, limbs);
        break;
    }
    progress.begin("refine");
    RefineOptions refine = options.refine;
    if (options.resample_model > 0.0)
        refine.even_spacing_world = options.resample_model * surface.world_from_model.scale;
    out.refine = refine_graph(graph, seed_points, query, refine);
    flatten(graph, surface, spread, out);
    out.forest_edges = out.nodes.size() - 1;
    return out;
}

}  // namespace zskel
