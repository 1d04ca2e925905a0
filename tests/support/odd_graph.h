#pragma once

#include <cmath>

#include "zskel/skeleton/graph.h"

namespace zskel::test {

/// A loop that hangs at a junction, a limb, a ring of its own, and a lone node; numbers that need
/// all digits. Branches: 0-1-2-3-1 has a loop; 5-6-7 is the ring.
inline SkeletonGraph odd_graph() {
    SkeletonGraph graph;
    graph.nodes = {{{0.1, -1.0 / 3, 1e-17}, 0.1, 0, 1.0 / 7},
                   {{1, 0, 0}, 0.5, 0, 2.5},
                   {{2, 1e-3, 0.25}, 0.25, 0, -1e-12},
                   {{2, -4, 1e5 / 3}, 0, 0, 0},
                   {{1e20, 5, -5}, std::sqrt(2.0), 1, 0},
                   {{10, 0, 0}, 0.3, 7, 0},
                   {{11, 0, 0}, 0.2, 7, 0},
                   {{10.5, 1, 0}, 0.4, 7, 0}};
    graph.edges = {{0, 1}, {1, 2}, {1, 3}, {2, 3}, {5, 6}, {5, 7}, {6, 7}};
    graph.vertex_node = {0, 4, kNone, 2};
    return graph;
}

}  // namespace zskel::test
