#include "zskel/skeleton/refine.h"

#include "zskel/skeleton/centring.h"
#include "zskel/skeleton/ends.h"
#include "zskel/skeleton/junctions.h"
#include "zskel/skeleton/resample.h"

namespace zskel {

RefineReport refine_graph(CurveGraph& graph, std::span<const Vec3> seed_points,
                          const SurfaceQuery& query, const RefineOptions& options) {
    RefineReport report;
    report.merged_junctions = merge_junctions(graph, query, options.merge_radii);
    report.extended_ends = extend_ends(graph, seed_points, query, options);
    resample_branches(graph, seed_points, query, options);
    centre_branches(graph, query, options);
    aim_ends(graph, query, options);
    resample_branches(graph, seed_points, query, options);
    for (CurveGraph::Node& node : graph.nodes) {
        if (!node.is_removed) node.radius = query.nearest(node.position).distance;
    }
    return report;
}

}  // namespace zskel
