#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/skeleton/branches.h"
#include "zskel/skeleton/limbs.h"
#include "zskel/skeleton/network.h"

namespace zskel {

/// A skeleton of one solid while it is worked on, world space.
struct CurveGraph {
    struct Node {
        Vec3 position{0.0f};
        float radius = 0.0f;               ///< inscribed
        std::vector<std::uint32_t> links;  ///< neighbours; none where it is removed
        std::vector<std::uint32_t> seeds;  ///< that came to rest here: their surface belongs to it
        bool is_removed = false;
    };
    std::vector<Node> nodes;

    const Vec3& at(std::uint32_t node) const { return nodes[node].position; }
    std::uint32_t add(const Vec3& position, float radius = 0.0f);
    void link(std::uint32_t a, std::uint32_t b);
    void unlink(std::uint32_t a, std::uint32_t b);
    float length_along(std::span<const std::uint32_t> branch) const;
    /// Removes a node, whose seeds another one gets. Links are the caller's to undo.
    void give_up(std::uint32_t node, std::uint32_t to);

    /// See `walk_branch` and `trace_branches`.
    std::vector<std::uint32_t> branch_from(std::uint32_t first, std::uint32_t second) const;
    std::vector<std::vector<std::uint32_t>> branches() const;
};

/// Nodes at the kept clusters' centres and along their connections' paths.
CurveGraph build_graph(const ClusterContext& context, const Limbs& limbs);

}  // namespace zskel
