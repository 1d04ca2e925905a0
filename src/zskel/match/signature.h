#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "zskel/skeleton/graph.h"

namespace zskel {

/// Stations along a skeleton that a signature has, and values of each.
inline constexpr std::size_t kStations = 48;
inline constexpr std::size_t kProfile = 16;

/// What lies round one place of a skeleton, in cube roots of the shape's volume; the same in any
/// pose, since ways along the skeleton do not change when limbs bend.
struct Station {
    std::uint32_t node = 0;                   ///< of the skeleton, that stands there
    std::array<float, kProfile> by_volume{};  ///< ways within which 1/32, 3/32, ... of the volume
                                              ///< lies
    std::array<float, kProfile> by_length{};  ///< the same of the skeleton's length
    float radius = 0.0f;
};

/// A skeleton as a weighted graph, boiled down to what shapes are compared by: stations that each
/// stand for an equal share of its length.
using Signature = std::vector<Station>;

/// @param graph  with radii. In solids whose nodes have no volumes (open ones) stretches of tubes
/// of their radii count. Parts that do not hang together are as far from each other as the largest
/// part is long.
/// @throws InputError for a graph without any node or extent.
Signature signature_of(const SkeletonGraph& graph);

/// Two shapes laid upon each other.
struct Match {
    double distance = 0.0;             ///< 0 for one shape; mean cost of a matched station
    std::vector<std::uint32_t> other;  ///< of every station of the one: the station of the other
};

/// The assignment of stations to stations that costs least. The cost of two stations is the mean
/// difference of their profiles, which is the Wasserstein distance of the distributions of ways
/// that start there (the third lower bound of Memoli's Gromov-Wasserstein distance), and of their
/// radii. Symmetric, but for rounding.
/// @see Memoli 2011 (Gromov-Wasserstein distances and the metric approach to object matching)
Match match_signatures(const Signature& a, const Signature& b);

}  // namespace zskel
