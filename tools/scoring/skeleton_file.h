#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zskel/skeleton/graph.h"

namespace zskel::scoring {

/// A skeleton from a file, in model space; `vertex_node` is empty.
struct SkeletonFile {
    SkeletonGraph graph;  ///< edges sorted, each once, none from a node to itself
    bool has_radii = false;
    std::optional<double> evaluations;  ///< where the file has statistics
    std::optional<double> seconds;
};

/// Reads JSON with `nodes` (objects with `position`, and `radius` and `id` where known; or arrays
/// of three numbers) and `edges` (objects with `source` and `target`; or arrays of two).
/// @throws InputError naming the path and what is wrong.
SkeletonFile read_skeleton(const std::string& path);

/// A named part of a true skeleton.
struct Limb {
    std::string name;
    std::vector<std::uint32_t> nodes;  ///< from the joint to the end
    bool is_tube = false;              ///< the nodes' radii are distances to the surface
};

/// The skeleton that a model was built from, radii at every node.
struct Truth {
    SkeletonGraph graph;
    std::vector<Limb> limbs;
};

/// Reads a skeleton with `limbs`. @throws InputError, also where a node has no radius.
Truth read_truth(const std::string& path);

}  // namespace zskel::scoring
