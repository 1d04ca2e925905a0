#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/skeleton/network.h"

namespace zskel {

struct LimbOptions {
    double detail = 1.0;  ///< scales what counts as a limb: below 1 more do, above 1 fewer
    double least_own_radii = 2.5;       ///< a limb sticks out of the rest by at least this many of
                                        ///< its own girths,
    double least_junction_radii = 0.5; ///< and of the radius where it begins,
    double least_length_radii = 0.8;    ///< and is at least this many of that long
};

/// What of a network is skeleton.
struct Limbs {
    /// A way on from the cluster at the end of a limb, along which the seed came that sticks out.
    struct Tip {
        std::uint32_t cluster = 0;
        std::vector<Vec3> path;  ///< from the cluster's centre outwards
    };
    std::vector<std::uint32_t> connections;  ///< kept
    std::vector<std::uint32_t> home;         ///< of every cluster: itself if kept, else the kept
                                             ///< cluster that the best way from it leads to
    std::vector<Tip> tips;
    std::size_t limbs = 0;
    std::size_t rejected = 0;  ///< clusters' own seeds that stuck out, but not far enough
};

/// Starts from the cycles of the network (where there is none, from its thickest cluster), and adds
/// limbs as long as some seed's surface point sticks out of the inscribed balls along what is kept:
/// the way from the cluster of the seed that sticks out farthest, along the thick middle, is a limb
/// when it is large enough for its own thickness and for that of the body that it grows from.
/// @see Sato et al. 2000 (TEASAR) for paths from the farthest uncovered point; the measures are ours.
Limbs grow_limbs(const ClusterContext& context, const ClusterNetwork& network,
                 const LimbOptions& options);

}  // namespace zskel
