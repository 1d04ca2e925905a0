#include "zskel/skeleton/surface_walks.h"

#include <algorithm>

namespace zskel {

using Class = HandleClasses::Class;

SurfaceWalks::SurfaceWalks(const ClusterContext& context, const HandleClasses& handles)
    : context_(context),
      handles_(handles),
      graph_(context.surface.positions.size(), context.surface.edges) {
    walk_cells();
    find_links();
    walk_clusters();
}

void SurfaceWalks::walk_cells() {
    cell_sums_.assign(graph_.size(), 0);
    std::vector<bool> is_done(graph_.size(), false);
    for (std::uint32_t v = 0; v < graph_.size(); ++v) {
        std::vector<std::uint32_t> way;
        std::uint32_t at = v;
        for (; !is_done[at] && context_.spread.parent[at] != at; at = context_.spread.parent[at])
            way.push_back(at);
        is_done[at] = true;
        for (auto next = way.rbegin(); next != way.rend(); ++next) {
            cell_sums_[*next] =
                cell_sums_[at] + handles_.edge_sum(edge_between(at, *next), at < *next);
            is_done[*next] = true;
            at = *next;
        }
    }
}

std::uint32_t SurfaceWalks::edge_between(std::uint32_t v, std::uint32_t w) const {
    const auto links = graph_.of(v);
    return std::find_if(links.begin(), links.end(),
                        [w](const VertexGraph::Link& link) { return link.vertex == w; })
        ->edge;
}

void SurfaceWalks::find_links() {
    for (const glm::uvec2& edge : context_.surface.edges) {
        const std::uint32_t a = context_.spread.seed_of[edge.x];
        const std::uint32_t b = context_.spread.seed_of[edge.y];
        if (a != b)
            links_.try_emplace(std::minmax(a, b), a < b ? edge : glm::uvec2(edge.y, edge.x));
    }
}

glm::uvec2 SurfaceWalks::link_between(std::uint32_t from, std::uint32_t to) const {
    const glm::uvec2 link = links_.at(std::minmax(from, to));
    return from < to ? link : glm::uvec2(link.y, link.x);
}

std::uint64_t SurfaceWalks::link_sum(std::uint32_t from, std::uint32_t to) const {
    const glm::uvec2 link = link_between(from, to);
    return cell_sums_[link.x] + handles_.edge_sum(edge_between(link.x, link.y), link.x < link.y) -
           cell_sums_[link.y];
}

void SurfaceWalks::add_cell_class(Class& sum, std::uint32_t vertex, bool is_forward) const {
    for (std::uint32_t v = vertex; context_.spread.parent[v] != v; v = context_.spread.parent[v]) {
        const std::uint32_t before = context_.spread.parent[v];
        handles_.add_edge(sum, edge_between(before, v), (before < v) == is_forward);
    }
}

void SurfaceWalks::add_link_class(Class& sum, std::uint32_t from, std::uint32_t to) const {
    const glm::uvec2 link = link_between(from, to);
    add_cell_class(sum, link.x, true);
    handles_.add_edge(sum, edge_between(link.x, link.y), link.x < link.y);
    add_cell_class(sum, link.y, false);
}

std::vector<std::vector<SurfaceWalks::Way>> SurfaceWalks::find_ways() const {
    std::vector<std::vector<Way>> ways(context_.spread.vertices.size());
    const auto add_way = [&](const std::vector<std::uint32_t>& seeds) {
        const std::uint32_t a = seeds.front();
        const std::uint32_t b = seeds.back();
        if (context_.clusters.of_point[a] != context_.clusters.of_point[b]) return;
        ways[a].push_back({b, seeds});
        ways[b].push_back({a, {seeds.rbegin(), seeds.rend()}});
    };
    for (const glm::uvec2& link : context_.links) add_way({link.x, link.y});
    for (const Shortcut& shortcut : context_.shortcuts) add_way(shortcut.walk);
    return ways;
}

void SurfaceWalks::walk_clusters() {
    const std::size_t seeds = context_.spread.vertices.size();
    central_.assign(context_.clusters.centers.size(), kNone);
    for (std::uint32_t s = 0; s < seeds; ++s) {
        const std::uint32_t c = context_.clusters.of_point[s];
        if (central_[c] == kNone && context_.settled[s].position == context_.clusters.centers[c])
            central_[c] = s;
    }
    const std::vector<std::vector<Way>> ways = find_ways();
    seed_sums_.assign(seeds, 0);
    seed_classes_.assign(seeds, {});
    ways_.assign(seeds, {});
    for (const std::uint32_t root : central_) {
        seed_classes_[root] = handles_.zero();
        std::vector<Vec3> start;
        append_seed_walk(root, start);
        seed_sums_[root] = sum_of(start);
        ways_[root].seed = root;
        std::vector<std::uint32_t> queue{root};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::uint32_t from = queue[i];
            for (const Way& way : ways[from]) {
                if (ways_[way.seed].seed != kNone) continue;
                ways_[way.seed] = {from, way.seeds};
                seed_sums_[way.seed] = seed_sums_[from];
                seed_classes_[way.seed] = seed_classes_[from];
                for (std::size_t k = 1; k < way.seeds.size(); ++k) {
                    seed_sums_[way.seed] += link_sum(way.seeds[k - 1], way.seeds[k]);
                    add_link_class(seed_classes_[way.seed], way.seeds[k - 1], way.seeds[k]);
                }
                queue.push_back(way.seed);
            }
        }
    }
}

Class SurfaceWalks::class_to(std::uint32_t vertex) const {
    Class cls = seed_classes_[context_.spread.seed_of[vertex]];
    add_cell_class(cls, vertex, true);
    return cls;
}

std::vector<std::uint32_t> SurfaceWalks::parents_of(std::uint32_t vertex) const {
    std::vector<std::uint32_t> out{vertex};
    while (context_.spread.parent[out.back()] != out.back())
        out.push_back(context_.spread.parent[out.back()]);
    return out;
}

// From where a seed rests to its vertex.
void SurfaceWalks::append_seed_walk(std::uint32_t seed, std::vector<Vec3>& way) const {
    const SettledSeed& settled = context_.settled[seed];
    way.push_back(settled.position);
    way.insert(way.end(), settled.path.rbegin(), settled.path.rend());
    way.push_back(context_.inner[context_.spread.vertices[seed]]);
}

std::vector<Vec3> SurfaceWalks::walk_to(std::uint32_t vertex) const {
    std::vector<std::uint32_t> seeds;  // from the last to the central one
    std::uint32_t at = context_.spread.seed_of[vertex];
    seeds.push_back(at);
    while (ways_[at].seed != at) {
        seeds.insert(seeds.end(), ways_[at].seeds.rbegin() + 1, ways_[at].seeds.rend());
        at = ways_[at].seed;
    }
    std::vector<Vec3> way;
    append_seed_walk(at, way);
    const auto append = [&](const auto& first, const auto& last) {
        for (auto v = first; v != last; ++v) way.push_back(context_.inner[*v]);
    };
    for (std::size_t k = seeds.size() - 1; k > 0; --k) {
        const glm::uvec2 link = link_between(seeds[k], seeds[k - 1]);
        const std::vector<std::uint32_t> out = parents_of(link.x);
        const std::vector<std::uint32_t> in = parents_of(link.y);
        append(out.rbegin(), out.rend());
        append(in.begin(), in.end());
    }
    const std::vector<std::uint32_t> last = parents_of(vertex);
    append(last.rbegin(), last.rend());
    return way;
}

std::vector<Vec3> SurfaceWalks::short_way_to(std::uint32_t vertex) const {
    std::vector<Vec3> way{context_.clusters.centers[cluster_of(vertex)]};
    append_seed_walk(context_.spread.seed_of[vertex], way);
    const std::vector<std::uint32_t> parents = parents_of(vertex);
    for (auto v = parents.rbegin(); v != parents.rend(); ++v) way.push_back(context_.inner[*v]);
    return way;
}

std::uint64_t SurfaceWalks::sum_of(std::span<const Vec3> path) const {
    std::uint64_t sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += handles_.segment_sum(path[i - 1], path[i]);
    return sum;
}

}  // namespace zskel
