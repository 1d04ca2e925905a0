#pragma once

#include <vector>

#include "zskel/core/disjoint_sets.h"
#include "zskel/skeleton/network.h"

namespace zskel {

/// The mesh joins nothing across a solid's shells (a ball with a cavity): joins the sets of
/// clusters by the shortest straight connections that are free, and where none is, by the shortest,
/// marked as not inside. No cycle comes of it, and none is missed: what goes round inside a solid
/// goes round on its shells. Pairs are looked at by distance, to twice as far as it takes: where
/// shells see one another, few each.
void bridge_shells(const ClusterContext& context, DisjointSets& sets, ClusterNetwork& network);

}  // namespace zskel
