#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace zskel::models {

/// A part of the skeleton with a name; `is_tube` says that its radii are distances to the surface.
struct TruthLimb {
    std::string name;
    std::vector<std::size_t> nodes;
    bool is_tube = true;
};

/// The skeleton that a model was built from.
struct Truth {
    struct Node {
        glm::dvec3 position;
        double radius;
    };
    std::vector<Node> nodes;
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    std::vector<TruthLimb> limbs;
};

/// Number of edges at each node.
std::vector<std::size_t> count_degrees(const Truth& truth);

/// Number of nodes with one edge.
std::size_t count_ends(const Truth& truth);

/// First Betti number: edges - nodes + components.
std::size_t count_cycles(const Truth& truth);

}  // namespace zskel::models
