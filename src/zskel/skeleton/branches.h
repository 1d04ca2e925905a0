#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace zskel {

/// The neighbours of every node of a graph; each edge stands in two lists.
using NodeLinks = std::vector<std::vector<std::uint32_t>>;

/// Nodes from `first` over its neighbour `second` to the next end or junction (a node without
/// exactly two neighbours), or round to `first`.
/// @param links_of  the neighbours of a node, as a range of node numbers.
template <typename LinksOf>
std::vector<std::uint32_t> walk_branch(const LinksOf& links_of, std::uint32_t first,
                                       std::uint32_t second) {
    std::vector<std::uint32_t> path{first, second};
    while (links_of(path.back()).size() == 2 && path.back() != first) {
        const auto& links = links_of(path.back());
        path.push_back(links[0] == path[path.size() - 2] ? links[1] : links[0]);
    }
    return path;
}

/// Every branch once, from its lower end; rings without a junction start and end at their lowest
/// node. Nodes without neighbours are on none.
template <typename LinksOf>
std::vector<std::vector<std::uint32_t>> trace_branches(std::size_t node_count,
                                                       const LinksOf& links_of) {
    std::vector<std::vector<std::uint32_t>> out;
    std::vector<bool> seen(node_count, false);
    for (std::uint32_t n = 0; n < node_count; ++n) {
        if (links_of(n).size() == 2) continue;
        for (const std::uint32_t next : links_of(n)) {
            std::vector<std::uint32_t> path = walk_branch(links_of, n, next);
            const bool is_mirror =
                path.back() < n || (path.back() == n && path[1] > path[path.size() - 2]);
            for (const std::uint32_t p : path) seen[p] = true;
            if (!is_mirror) out.push_back(std::move(path));
        }
    }
    for (std::uint32_t n = 0; n < node_count; ++n) {
        if (seen[n] || links_of(n).size() != 2) continue;
        out.push_back(walk_branch(links_of, n, links_of(n)[0]));
        for (const std::uint32_t p : out.back()) seen[p] = true;
    }
    return out;
}

}  // namespace zskel
