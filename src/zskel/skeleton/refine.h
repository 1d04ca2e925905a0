#pragma once

#include <cstddef>
#include <span>

#include "zskel/skeleton/curve_graph.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

struct RefineOptions {
    double merge_radii = 0.5;          ///< junctions nearer than this become one
    double tip_gap_radii = 0.3;        ///< ends are extended to this distance from the tip
    double min_spacing_world = 0.004;  ///< of nodes; between these bounds it is the radius
    double max_spacing_world = 0.02;
    double even_spacing_world = 0.0;  ///< in the end nodes are evenly spread, at most so far apart;
                                      ///< 0: by the radius
    int smoothing_sweeps = 12;        ///< before, of smoothing alone
    int sweeps = 60;                  ///< of centring and smoothing
    double centring = 0.35;  ///< share of the way to the section's centre that a sweep takes
    double longest_move_radii = 0.3;  ///< but no longer than this, in inscribed radii
    double junction_radii = 1.7;      ///< nearer to a junction the centring fades: a section says
                                      ///< little where branches part;
    double junction_pull = 0.25;  ///< a sweep takes a junction so much of the way to the thickest
                                  ///< place near it, times how steeply the radius grows to there:
                                  ///< in a flat section it says little
    double junction_reach_radii = 0.5;  ///< how near that is, in the radius at the junction
    double smoothing = 0.7;             ///< share of the way to the middle of the neighbours,
    double unshrink = 0.55;             ///< and then away from it, so that bends are not cut
    double zip_radii = 0.3;        ///< branches nearer to each other than this go side by side;
    double zip_least_radii = 0.6;  ///< they become one where they do so as far as this
    double aim_radii = 1.75;       ///< the last stretch of so many radii goes straight on
    double aim_least =
        0.7;  ///< unless that is shorter than this share of it, or longer by a radius
};

/// Settings by which branches keep to the shape's own bends (the paper's active contour): more
/// centring and less smoothing than by default.
RefineOptions active_contour();

struct RefineReport {
    std::size_t merged_junctions = 0;
    std::size_t extended_ends = 0;
    std::size_t unfolded_branches = 0;  ///< see `unfold_branches`
    std::size_t zipped_branches = 0;    ///< see `zip_branches`
};

/// Merges junctions, unfolds what goes out and back, extends ends to the tips, centres and smooths
/// the branches, makes one of those that go side by side, and sends ends straight on. No segment
/// that was free is left unfree, and cycles stay.
/// @param seed_points  where every seed's vertex is on the surface.
RefineReport refine_graph(CurveGraph& graph, std::span<const Vec3> seed_points,
                          const SurfaceQuery& query, const RefineOptions& options);

}  // namespace zskel
