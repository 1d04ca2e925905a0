#pragma once

#include <cstdint>
#include <vector>

#include "zskel/skeleton/network.h"

namespace zskel {

/// What a limb must have. It sticks out of the balls along the rest of the skeleton; how far is
/// measured in girths (see `girths_at`): of its own, outside the ball where it begins, and of the
/// body at that place.
struct LimbOptions {
    double detail = 1.0;             ///< scales all bounds: below 1 more limbs, above 1 fewer
    double least_world = 0.02;       ///< sticks out at least this far, in the solid's size,
    double least_own_girths = 1.0;   ///< this many of its own girths,
    double least_body_girths = 0.2;  ///< and of the body's,
    double least_product = 0.56;     ///< and so much by the product of the two
    double bare_own_sizes =
        2.1;  ///< where no seed came to rest beyond the ball: so many radii of a circle as large as
              ///< its section, which is flat at an ear's rim,
    double bare_product = 2.5;  ///< so much by the product of those and the body's girths,
    double bare_world = 0.12;   ///< or as far as this
    double flat_girths = 4.5;   ///< where its section is wider than so many girths, it is part of a
    double flat_widths = 2.5;   ///< sheet: as long as so many half widths of it
    double fat_area = 3.0;      ///< a fat end has at least this area, in squares of its own depth,
    double fat_depth = 0.38;    ///< a mean depth of this many of the body's girths,
    double fat_gain = 0.5;      ///< and brings this share of the area near to the skeleton,
    double fat_roundness = 1.53;  ///< on a body whose girth is at most so many of its radii
};

/// What of a network is skeleton.
struct Limbs {
    /// A way on from the cluster at the end of a limb, along which a seed came.
    struct Tip {
        std::uint32_t cluster = 0;
        std::vector<Vec3> path;  ///< from the cluster's centre outwards
    };
    std::vector<Connection> connections;  ///< kept, and straight ones in place of detours
    std::vector<Tip> tips;
    std::vector<std::uint32_t> home;  ///< of every cluster: itself if kept, else the kept cluster
                                      ///< that the best way from it leads to
    std::size_t limbs = 0;            ///< grown
    std::size_t rejected = 0;         ///< seeds that stuck out, but not far enough
};

/// Starts from the cycles of the network (where there is none, from its thickest cluster), and adds
/// limbs as long as the surface at some seed sticks out of the balls along what is kept: the way
/// from the rest place of the seed that sticks out farthest, along the thick middle, straight
/// where connections lead out and back past a cluster, and on to where the seed came from if its
/// place is still far. Then fat ends: a part that hardly sticks out of the ball of its body, as a
/// vase's foot, but lies far from it in its own thickness.
/// @see Sato et al. 2000 (TEASAR) for paths from the farthest place not covered; the measures of
///      what is covered and what is a limb are ours.
Limbs grow_limbs(const ClusterContext& context, const ClusterNetwork& network,
                 const LimbOptions& options);

}  // namespace zskel
