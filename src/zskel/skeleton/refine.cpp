#include "zskel/skeleton/refine.h"

#include "zskel/skeleton/centring.h"
#include "zskel/skeleton/ends.h"
#include "zskel/skeleton/junctions.h"
#include "zskel/skeleton/resample.h"
#include "zskel/skeleton/unfold.h"
#include "zskel/skeleton/zip.h"

namespace zskel {

RefineOptions active_contour() {
    RefineOptions options;
    options.centring = 0.5;
    options.smoothing = 0.4;
    options.unshrink = 0.36;
    return options;
}

namespace {

// All but the new junctions is centred already.
RefineOptions after_zipping(RefineOptions options) {
    options.smoothing_sweeps = 0;
    options.sweeps /= 5;
    return options;
}

}  // namespace

RefineReport refine_graph(CurveGraph& graph, std::span<const Vec3> seed_points,
                          const SurfaceQuery& query, const RefineOptions& options) {
    RefineReport report;
    report.merged_junctions = merge_junctions(graph, query, options.merge_radii);
    report.unfolded_branches = unfold_branches(graph, query, options);
    report.extended_ends = extend_ends(graph, seed_points, query, options);
    resample_branches(graph, seed_points, query, options, Spacing::ByRadius);
    centre_branches(graph, query, options);
    report.zipped_branches = zip_branches(graph, query, options);
    const std::size_t unfolded = unfold_branches(graph, query, options);
    report.unfolded_branches += unfolded;
    if (report.zipped_branches + unfolded > 0)
        centre_branches(graph, query, after_zipping(options));
    aim_ends(graph, query, options);
    resample_branches(graph, seed_points, query, options,
                      options.even_spacing_world > 0.0 ? Spacing::Even : Spacing::ByRadius);
    for (CurveGraph::Node& node : graph.nodes) {
        if (!node.is_removed) node.radius = query.nearest(node.position).distance;
    }
    return report;
}

}  // namespace zskel
