#include "zskel/skeleton/shortcuts.h"

#include <algorithm>

#include "zskel/core/parallel.h"
#include "zskel/mesh/vertex_graph.h"

namespace zskel {
namespace {

// A breadth-first walk from one seed over those that ended in its ball. `seen` holds, of every
// seed, one more than the last that looked at it.
std::vector<Shortcut> shortcuts_of(std::uint32_t first, std::span<const Vec3> ends,
                                   const VertexGraph& graph, float radius,
                                   std::span<const float> ranges,
                                   std::vector<std::uint32_t>& seen) {
    std::vector<std::uint32_t> reached{first};
    std::vector<std::uint32_t> from{0};
    std::vector<std::uint32_t> depth{0};
    seen[first] = first + 1;
    std::vector<Shortcut> out;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const VertexGraph::Link& link : graph.of(reached[i])) {
            const std::uint32_t next = link.vertex;
            if (seen[next] == first + 1) continue;
            seen[next] = first + 1;
            if (glm::distance(ends[first], ends[next]) > radius) continue;
            reached.push_back(next);
            from.push_back(static_cast<std::uint32_t>(i));
            depth.push_back(depth[i] + 1);
            const float range = std::min(ranges[first], ranges[next]);
            const bool is_near = glm::distance(ends[first], ends[next]) <= range;
            if (depth.back() < 2 || next < first || !is_near) continue;
            Shortcut shortcut;
            for (std::size_t k = reached.size() - 1; k != 0; k = from[k])
                shortcut.walk.push_back(reached[k]);
            shortcut.walk.push_back(first);
            std::reverse(shortcut.walk.begin(), shortcut.walk.end());
            out.push_back(std::move(shortcut));
        }
    }
    return out;
}

}  // namespace

std::vector<Shortcut> find_shortcuts(std::span<const Vec3> ends, std::span<const glm::uvec2> links,
                                     std::span<const float> radii, std::span<const float> ranges) {
    const VertexGraph graph(ends.size(), links);
    std::vector<std::vector<Shortcut>> found(ends.size());
    parallel_for(ends.size(), 16, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> seen(ends.size(), 0);
        for (std::size_t i = begin; i < end; ++i) {
            found[i] =
                shortcuts_of(static_cast<std::uint32_t>(i), ends, graph, radii[i], ranges, seen);
        }
    });
    std::vector<Shortcut> out;
    for (std::vector<Shortcut>& list : found) {
        for (Shortcut& shortcut : list) out.push_back(std::move(shortcut));
    }
    return out;
}

}  // namespace zskel
