#pragma once

#include <initializer_list>
#include <set>
#include <vector>

#include "support/shapes.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/curve_graph.h"

namespace zskel::test {

inline constexpr float kStep = 0.04f;

// New nodes from a node on, evenly along a line to each of the points; returns the last.
inline std::uint32_t draw(CurveGraph& graph, std::uint32_t from,
                          std::initializer_list<Vec3> points) {
    for (const Vec3& to : points) {
        const Vec3 start = graph.at(from);
        const auto pieces = static_cast<int>(glm::distance(start, to) / kStep) + 1;
        for (int k = 1; k <= pieces; ++k) {
            const float share = static_cast<float>(k) / static_cast<float>(pieces);
            const std::uint32_t next = graph.add(glm::mix(start, to, share));
            graph.nodes[next].seeds = {next};
            graph.link(from, next);
            from = next;
        }
    }
    return from;
}

struct Ends {
    std::vector<Vec3> junctions;
    std::size_t ends = 0;
    std::size_t branches = 0;
    std::set<std::uint32_t> seeds;
};
inline Ends ends_of(const CurveGraph& graph) {
    Ends out;
    for (const CurveGraph::Node& node : graph.nodes) {
        if (node.is_removed) continue;
        if (node.links.size() > 2) out.junctions.push_back(node.position);
        out.ends += node.links.size() == 1 ? 1 : 0;
        out.seeds.insert(node.seeds.begin(), node.seeds.end());
    }
    out.branches = graph.branches().size();
    return out;
}

struct Tube {
    PreparedSurface prepared = prepare_surface(test::cylinder(0.25, 2.0, 24, 41));
    SurfaceQuery query{prepared.surface};
    float radius = query.nearest(Vec3(0.0f)).distance;
};

}  // namespace zskel::test
