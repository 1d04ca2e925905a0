#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/mesh/small_handles.h"
#include "zskel/skeleton/cluster.h"
#include "zskel/skeleton/limbs.h"
#include "zskel/skeleton/newton.h"
#include "zskel/skeleton/refine.h"
#include "zskel/skeleton/seeds.h"
#include "zskel/skeleton/settle.h"
#include "zskel/skeleton/spread.h"

namespace zskel {

/// The skeleton of one solid, world space, with the solid's own vertex numbers.
struct SolidSkeleton {
    std::vector<Vec3> nodes;
    std::vector<float> radii;                ///< inscribed
    std::vector<double> volumes;             ///< world units; empty on open surfaces
    std::vector<glm::uvec2> edges;           ///< lower node first, each once, sorted
    std::vector<std::uint32_t> vertex_node;  ///< of every vertex
    std::vector<std::uint32_t> open_ends;    ///< nodes at the middles of openings
    std::vector<Seed> seeds;
    std::vector<SettledSeed> settled;  ///< of every seed
    std::size_t forest_edges = 0;      ///< edges left when every cycle is opened at its longest
    std::size_t expected_cycles = 0;   ///< handles but those ignored; 0 where they are not known
    bool knows_cycles = false;         ///< whether handles were looked for and found out about
    std::vector<SmallHandle> ignored_handles;
    double seed_spacing_thickness = 0.0;  ///< see SeedSpread; newton only
    SpreadEnd seed_end = SpreadEnd::EveryVertex;
    std::size_t limbs = 0;  ///< that grew from the cycles or the thickest node
    std::size_t rejected_limbs = 0;
    RefineReport refine;
    std::vector<std::string> warnings;
};

/// Told of each stage as it begins, and of its share done.
struct MethodProgress {
    std::function<void(std::string_view stage)> begin;
    std::function<void(double share)> report;
};

/// The published method (Wu et al. 2003).
struct PaperMethodOptions {
    SeedOptions seeds;
    PaperStepOptions steps;
    ClusterOptions clusters;
};
SolidSkeleton extract_by_paper(const Surface& surface, const SurfaceQuery& query,
                               VisibilitySource& source, const PaperMethodOptions& options,
                               const MethodProgress& progress);

/// Newton steps from spread seeds, a network with the solid's topology, refined.
/// @param is_closed  whether handles are to be found; on an open surface the network is a forest.
/// @param make_source  called once, beside other work; what it makes is let go of when all seeds
/// are
///                     at rest.
struct NewtonMethodOptions {
    SeedOptions seeds;
    SpreadOptions spread;
    NewtonOptions steps;
    double cluster_radii = 0.5;        ///< range within which end points become one, in local radii
    double min_cluster_world = 0.006;  ///< but between these
    double max_cluster_world = 0.05;
    LimbOptions limbs;
    int max_retries = 4;            ///< each with half the range where clusters go round a handle
    double min_handle_model = 0.0;  ///< handles of a smaller radius get no cycle; see SmallHandle
    RefineOptions refine;
    double resample_model = 0.0;  ///< nodes evenly spread, at most so far apart; 0: by the radius
};
/// For what has no inside to be in the middle of: seeds stay on the sheet, and of the many ways
/// along it only few are taken.
NewtonMethodOptions for_sheets(NewtonMethodOptions options);
SolidSkeleton extract_by_newton(
    const Surface& surface, const SurfaceQuery& query, bool is_closed,
    const std::function<std::unique_ptr<VisibilitySource>()>& make_source,
    const NewtonMethodOptions& options, const MethodProgress& progress);

}  // namespace zskel
