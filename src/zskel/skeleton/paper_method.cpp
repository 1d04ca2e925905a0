#include "zskel/skeleton/connect.h"
#include "zskel/skeleton/method.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

SolidSkeleton extract_by_paper(const Surface& surface, const SurfaceQuery& query,
                               VisibilitySource& source, const PaperMethodOptions& options,
                               const MethodProgress& progress) {
    SolidSkeleton out;
    progress.begin("seeds");
    out.seeds = place_seeds(surface, query, options.seeds);
    progress.begin("settle");
    out.settled = settle_seeds(source, out.seeds, options.steps, progress.report);
    progress.begin("cluster");
    std::vector<Vec3> ends;
    ends.reserve(out.settled.size());
    for (const SettledSeed& seed : out.settled) ends.push_back(seed.position);
    Clusters clusters = cluster_minima(ends, surface.edges, options.clusters);
    progress.begin("connect");
    out.edges = connect_clusters(clusters.of_point, surface.edges);
    out.forest_edges = spanning_forest(clusters.centers, out.edges).size();
    out.nodes = std::move(clusters.centers);
    out.vertex_node = std::move(clusters.of_point);
    for (const Vec3& center : out.nodes) out.radii.push_back(query.nearest(center).distance);
    return out;
}

}  // namespace zskel
