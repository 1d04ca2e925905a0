#include "zskel/self_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "zskel/core/disjoint_sets.h"

namespace zskel {
namespace {

constexpr int kPlaces = 64;
constexpr double kLeastInside = 0.9999;  // a share below this fails

bool is_inside(const SurfaceQuery& query, const Vec3& point) {
    return std::abs(query.winding_number(point)) > 0.5;
}

double share_inside(const SurfaceQuery& query, const Vec3& a, const Vec3& b) {
    int inside = 0;
    for (int k = 0; k < kPlaces; ++k) {
        const float share = (static_cast<float>(k) + 0.5f) / static_cast<float>(kPlaces);
        inside += is_inside(query, glm::mix(a, b, share)) ? 1 : 0;
    }
    return static_cast<double>(inside) / kPlaces;
}

// Nodes joined by free edges are on one side together.
std::vector<bool> nodes_inside(const SurfaceQuery& query, const SolidSkeleton& skeleton,
                               const std::vector<bool>& is_free) {
    DisjointSets sets(skeleton.nodes.size());
    for (std::size_t e = 0; e < skeleton.edges.size(); ++e) {
        if (is_free[e]) sets.unite(skeleton.edges[e].x, skeleton.edges[e].y);
    }
    std::vector<bool> inside(skeleton.nodes.size());
    for (std::uint32_t n = 0; n < skeleton.nodes.size(); ++n) {
        const std::uint32_t first = sets.find(n);  // the lowest of its set
        inside[n] = first == n ? is_inside(query, skeleton.nodes[n]) : inside[first];
    }
    return inside;
}

}  // namespace

void SkeletonChecker::add(const Solid& solid, const SurfaceQuery& query,
                          const SolidSkeleton& skeleton) {
    ++solids_;
    closed_ += solid.is_closed ? 1 : 0;
    knows_cycles_ = knows_cycles_ && skeleton.knows_cycles;
    expected_cycles_ += skeleton.expected_cycles;
    std::vector<bool> is_free;
    for (const glm::uvec2& edge : skeleton.edges)
        is_free.push_back(query.sees(skeleton.nodes[edge.x], skeleton.nodes[edge.y]));
    const std::vector<bool> inside = solid.is_closed
                                         ? nodes_inside(query, skeleton, is_free)
                                         : std::vector<bool>(skeleton.nodes.size(), true);
    const Similarity& world = solid.surface.world_from_model;
    const auto look_at = [&](const Vec3& point, bool is_in) {
        const double distance =
            world.length_to_model(static_cast<double>(query.nearest(point).distance));
        least_clearance_ = std::min(least_clearance_, is_in ? distance : -distance);
    };
    for (std::size_t n = 0; n < skeleton.nodes.size(); ++n) look_at(skeleton.nodes[n], inside[n]);
    for (std::size_t e = 0; e < skeleton.edges.size(); ++e) {
        const Vec3& a = skeleton.nodes[skeleton.edges[e].x];
        const Vec3& b = skeleton.nodes[skeleton.edges[e].y];
        const bool is_whole = is_free[e] || !solid.is_closed;
        const double share =
            is_whole ? (inside[skeleton.edges[e].x] ? 1.0 : 0.0) : share_inside(query, a, b);
        look_at(0.5f * (a + b), share > 0.5);
        if (!solid.is_closed) continue;
        const double length = world.length_to_model(static_cast<double>(glm::distance(a, b)));
        length_ += length;
        inside_ += length * share;
    }
}

SelfCheck SkeletonChecker::finish(const SkeletonGraph& graph) const {
    const GraphTopology topology = graph_topology(graph);
    SelfCheck check;
    check.components = topology.components;
    check.expected_components = solids_;
    check.cycles = topology.cycles;
    if (knows_cycles_) check.expected_cycles = expected_cycles_;
    const double without_edges = least_clearance_ < 0.0 ? 0.0 : 1.0;
    if (closed_ > 0) check.share_inside = length_ > 0.0 ? inside_ / length_ : without_edges;
    check.least_clearance = least_clearance_;
    if (check.components != check.expected_components)
        check.failures.push_back(fmt::format("{} components for {} solids", check.components,
                                             check.expected_components));
    if (check.expected_cycles && check.cycles != *check.expected_cycles)
        check.failures.push_back(
            fmt::format("{} cycles for {} handles", check.cycles, *check.expected_cycles));
    if (check.share_inside && *check.share_inside < kLeastInside)
        check.failures.push_back(
            fmt::format("{:.4f} of the length is inside", *check.share_inside));
    return check;
}

}  // namespace zskel
