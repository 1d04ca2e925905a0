#include "zskel/skeleton/refine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/skeleton/branches.h"
#include "zskel/skeleton/path.h"
#include "zskel/skeleton/section.h"

namespace zskel {
namespace {

using Node = CurveGraph::Node;

void link(CurveGraph& graph, std::uint32_t a, std::uint32_t b) {
    graph.nodes[a].links.push_back(b);
    graph.nodes[b].links.push_back(a);
}

void unlink_one(std::vector<std::uint32_t>& links, std::uint32_t node) {
    const auto at = std::find(links.begin(), links.end(), node);
    if (at != links.end()) links.erase(at);
}

void unlink(CurveGraph& graph, std::uint32_t a, std::uint32_t b) {
    unlink_one(graph.nodes[a].links, b);
    unlink_one(graph.nodes[b].links, a);
}

// Neighbours of a node; a removed one has none.
auto links_in(const CurveGraph& graph) {
    return [&graph](std::uint32_t n) -> const std::vector<std::uint32_t>& {
        return graph.nodes[n].links;
    };
}

std::vector<std::vector<std::uint32_t>> branches_of(const CurveGraph& graph) {
    return trace_branches(graph.nodes.size(), links_in(graph));
}

float branch_length(const CurveGraph& graph, const std::vector<std::uint32_t>& path) {
    float sum = 0.0f;
    for (std::size_t i = 1; i < path.size(); ++i) {
        sum += glm::distance(graph.nodes[path[i - 1]].position, graph.nodes[path[i]].position);
    }
    return sum;
}

// New nodes on from `first`, each linked to the one before; returns the last.
std::uint32_t add_chain(CurveGraph& graph, std::uint32_t first, std::span<const Vec3> points) {
    std::uint32_t last = first;
    for (const Vec3& point : points) {
        const auto next = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.emplace_back().position = point;
        link(graph, last, next);
        last = next;
    }
    return last;
}

void give_seeds(CurveGraph& graph, std::uint32_t from, std::uint32_t to) {
    auto& source = graph.nodes[from].seeds;
    auto& target = graph.nodes[to].seeds;
    target.insert(target.end(), source.begin(), source.end());
    source.clear();
}

class Refiner {
  public:
    Refiner(CurveGraph& graph, std::span<const Vec3> seed_points, const SurfaceQuery& query,
            const RefineOptions& options)
        : graph_(graph), seed_points_(seed_points), query_(query), options_(options) {}

    RefineReport run() {
        merge_junctions();
        extend_ends();
        resample();
        for (int i = 0; i < options_.smoothing_sweeps; ++i) smooth(options_.smoothing);
        weigh_centring();
        for (int i = 0; i < options_.sweeps; ++i) {
            centre();
            smooth(options_.smoothing);
            smooth(-options_.unshrink);
        }
        aim_ends();
        resample();
        for (Node& node : graph_.nodes) {
            if (!node.is_removed) node.radius = query_.nearest(node.position).distance;
        }
        return report_;
    }

  private:
    bool free_between(const Vec3& a, const Vec3& b) const { return !query_.first_hit(a, b); }

    // Two junctions become one, the one with the greater radius, when the other's neighbours can be
    // joined to it.
    void merge_junctions() {
        bool changed = true;
        while (changed) {
            changed = false;
            for (const std::vector<std::uint32_t>& branch : branches_of(graph_)) {
                if (branch.front() == branch.back()) continue;
                if (graph_.nodes[branch.front()].links.size() < 3 ||
                    graph_.nodes[branch.back()].links.size() < 3)
                    continue;
                if (try_merge(branch)) {
                    ++report_.merged_junctions;
                    changed = true;
                    break;
                }
            }
        }
    }

    bool try_merge(const std::vector<std::uint32_t>& branch) {
        std::uint32_t keep = branch.front();
        std::uint32_t drop = branch.back();
        if (graph_.nodes[keep].radius < graph_.nodes[drop].radius) std::swap(keep, drop);
        const double bound = options_.merge_radii * static_cast<double>(graph_.nodes[keep].radius);
        if (static_cast<double>(branch_length(graph_, branch)) >= bound) return false;
        const std::uint32_t last = drop == branch.back() ? branch[branch.size() - 2] : branch[1];
        std::vector<std::uint32_t> moved = graph_.nodes[drop].links;
        unlink_one(moved, last);
        for (const std::uint32_t n : moved) {
            const auto& kept = graph_.nodes[keep].links;
            const bool is_double =
                n == keep || std::find(kept.begin(), kept.end(), n) != kept.end();
            if (is_double || !free_between(graph_.nodes[n].position, graph_.nodes[keep].position))
                return false;
        }
        for (std::size_t i = 1; i < branch.size(); ++i) unlink(graph_, branch[i - 1], branch[i]);
        for (const std::uint32_t n : branch) {
            if (n == keep) continue;
            give_seeds(graph_, n, keep);
            graph_.nodes[n].is_removed = true;
        }
        for (const std::uint32_t n : moved) {
            unlink(graph_, n, drop);
            link(graph_, n, keep);
        }
        return true;
    }

    // An end goes on straight ahead, or to the farthest of its own surface when that lies farther
    // ahead.
    void extend_ends() {
        const std::size_t count = graph_.nodes.size();
        for (std::uint32_t n = 0; n < count; ++n) {
            const Node& node = graph_.nodes[n];
            if (node.is_removed || node.links.size() != 1) continue;
            const Vec3 back = node.position - before_end(n);
            if (!(glm::length(back) > 0.0f)) continue;
            const Vec3 ahead = glm::normalize(back);
            const auto hit = query_.first_hit(node.position, node.position + ahead);
            Vec3 tip = node.position + ahead * (hit ? hit->fraction : 0.0f);
            for (const std::uint32_t s : node.seeds) {
                const Vec3 way = seed_points_[s] - node.position;
                const bool is_ahead = glm::dot(way, ahead) > 0.8f * glm::length(way);
                if (is_ahead && glm::length(way) > glm::distance(tip, node.position))
                    tip = seed_points_[s];
            }
            extend_to(n, tip);
        }
    }

    // A point of the branch about one radius back from its end.
    Vec3 before_end(std::uint32_t end) const {
        const std::vector<std::uint32_t> path =
            walk_branch(links_in(graph_), end, graph_.nodes[end].links[0]);
        std::size_t i = 1;
        while (i + 1 < path.size() &&
               glm::distance(graph_.nodes[path[i]].position, graph_.nodes[end].position) <
                   graph_.nodes[end].radius) {
            ++i;
        }
        return graph_.nodes[path[i]].position;
    }

    void extend_to(std::uint32_t n, const Vec3& tip) {
        const Vec3 from = graph_.nodes[n].position;
        const float gap = static_cast<float>(options_.tip_gap_radii) * graph_.nodes[n].radius;
        const float distance = glm::distance(tip, from);
        if (distance <= 1.5f * gap) return;
        const Vec3 end = from + (tip - from) * (1.0f - gap / distance);
        if (!free_between(from, end)) return;
        Node extended;
        extended.position = end;
        extended.radius = query_.nearest(end).distance;
        graph_.nodes.push_back(std::move(extended));
        link(graph_, n, static_cast<std::uint32_t>(graph_.nodes.size() - 1));
        ++report_.extended_ends;
    }

    // Where there is hardly any thickness (open sheets), there is nothing to follow closely.
    double spacing_at(float radius) const {
        const auto r = static_cast<double>(radius);
        if (r < 0.25 * options_.min_spacing_world) return options_.max_spacing_world;
        return std::clamp(r, options_.min_spacing_world, options_.max_spacing_world);
    }

    // New nodes along every branch, as far apart as the local radius says; the seeds go to the
    // nearest of them.
    void resample() {
        for (const std::vector<std::uint32_t>& branch : branches_of(graph_)) {
            std::vector<Vec3> line;
            std::vector<std::uint32_t> seeds;
            for (std::size_t i = 0; i < branch.size(); ++i) {
                Node& node = graph_.nodes[branch[i]];
                line.push_back(node.position);
                if (i == 0 || i + 1 == branch.size()) continue;
                seeds.insert(seeds.end(), node.seeds.begin(), node.seeds.end());
                node.is_removed = true;
            }
            for (std::size_t i = 1; i < branch.size(); ++i)
                unlink(graph_, branch[i - 1], branch[i]);
            lay_nodes(branch.front(), branch.back(), line, seeds);
        }
    }

    void lay_nodes(std::uint32_t first, std::uint32_t last, const std::vector<Vec3>& line,
                   const std::vector<std::uint32_t>& seeds) {
        std::vector<std::uint32_t> chain{first};
        for (const Vec3& point : even_points(line, needed_pieces(first, last))) {
            Node node;
            node.position = point;
            node.radius = query_.nearest(point).distance;
            graph_.nodes.push_back(std::move(node));
            chain.push_back(static_cast<std::uint32_t>(graph_.nodes.size() - 1));
        }
        chain.push_back(last);
        for (std::size_t i = 1; i < chain.size(); ++i) link(graph_, chain[i - 1], chain[i]);
        for (const std::uint32_t s : seeds) {
            const Vec3& p = seed_points_[s];
            const std::uint32_t nearest =
                *std::min_element(chain.begin(), chain.end(), [&](auto l, auto r) {
                    return glm::distance(graph_.nodes[l].position, p) <
                           glm::distance(graph_.nodes[r].position, p);
                });
            graph_.nodes[nearest].seeds.push_back(s);
        }
    }

    // A ring needs three nodes and the second of two branches between the same junctions one of its
    // own.
    int needed_pieces(std::uint32_t first, std::uint32_t last) const {
        const auto& links = graph_.nodes[first].links;
        if (first == last) return 3;
        return std::find(links.begin(), links.end(), last) != links.end() ? 2 : 1;
    }

    // Points within the line, one local spacing apart. Corners stay where the shortcut past them is
    // not free.
    std::vector<Vec3> even_points(const std::vector<Vec3>& line, int least_pieces) const {
        const float longest = length_of(line) / static_cast<float>(least_pieces);
        std::vector<Vec3> points;
        Vec3 at = line.front();
        std::size_t next = 1;
        while (true) {
            const float spacing =
                std::min(longest, static_cast<float>(spacing_at(query_.nearest(at).distance)));
            Vec3 here = at;
            float left = spacing;
            std::size_t segment = next;
            while (segment < line.size() && glm::distance(here, line[segment]) <= left) {
                left -= glm::distance(here, line[segment]);
                here = line[segment++];
            }
            const bool is_last = segment >= line.size() ||
                                 (segment + 1 == line.size() &&
                                  glm::distance(here, line.back()) < left + 0.5f * spacing &&
                                  points.size() + 1 >= static_cast<std::size_t>(least_pieces));
            Vec3 target = is_last ? line.back()
                                  : here + (line[segment] - here) *
                                               (left / glm::distance(here, line[segment]));
            if (!free_between(at, target) && next < line.size() - (is_last ? 1 : 0) &&
                line[next] != at && segment > next) {
                target = line[next++];
                points.push_back(at = target);
                continue;
            }
            if (is_last) return points;
            next = segment;
            points.push_back(at = target);
        }
    }

    // One pass over all nodes but the ends: each towards the middle of its neighbours, or away from
    // it where `share` is negative. A move that would leave the solid is not made.
    void smooth(double share) {
        std::vector<std::pair<std::uint32_t, Vec3>> targets;
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            const Node& node = graph_.nodes[n];
            if (node.is_removed || node.links.size() < 2) continue;
            DVec3 middle(0.0);
            for (const std::uint32_t other : node.links)
                middle += DVec3(graph_.nodes[other].position);
            middle /= static_cast<double>(node.links.size());
            // A junction is held by its branches; the smoothing alone would drag it to the longest.
            const double held = node.links.size() > 2 ? 0.3 : 1.0;
            const DVec3 here(node.position);
            targets.emplace_back(n, Vec3(here + (middle - here) * (share * held)));
        }
        move(targets);
    }

    // How much each node within a branch is centred: little next to junctions.
    void weigh_centring() {
        centring_.assign(graph_.nodes.size(), 0.0f);
        for (const std::vector<std::uint32_t>& branch : branches_of(graph_)) {
            for (const std::uint32_t n : branch) {
                if (graph_.nodes[n].links.size() == 2)
                    centring_[n] = static_cast<float>(options_.centring);
            }
            fade_centring(branch.begin(), branch.end());
            fade_centring(branch.rbegin(), branch.rend());
        }
    }

    template <typename Iterator>
    void fade_centring(Iterator first, Iterator last) {
        const Node& junction = graph_.nodes[*first];
        if (junction.links.size() < 3) return;
        const float reach = static_cast<float>(options_.junction_radii) *
                            query_.nearest(junction.position).distance;
        for (; first != last; ++first) {
            const float away = glm::distance(graph_.nodes[*first].position, junction.position);
            if (away >= reach) return;
            centring_[*first] *= (away / reach) * (away / reach);
        }
    }

    // One pass over all nodes within branches, each towards the centre of its section.
    void centre() {
        std::vector<std::pair<std::uint32_t, Vec3>> targets;
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (centring_[n] > 0.0f) targets.emplace_back(n, Vec3(0.0f));
        }
        parallel_for(targets.size(), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) targets[i].second = centred(targets[i].first);
        });
        move(targets);
    }

    Vec3 centred(std::uint32_t n) const {
        const Node& node = graph_.nodes[n];
        const Vec3 chord = ahead_of(n, node.links[1]) - ahead_of(n, node.links[0]);
        if (!(glm::length(chord) > 0.0f)) return node.position;
        const Vec3 step =
            step_to_section_centre(query_, node.position, glm::normalize(chord)) * centring_[n];
        const float longest = static_cast<float>(options_.longest_move_radii) *
                              query_.nearest(node.position).distance;
        const float length = glm::length(step);
        return node.position + (length > longest ? step * (longest / length) : step);
    }

    // The last stretch of a branch goes straight on from where the section is whole: a flat end is
    // left through its middle, not at a corner.
    void aim_ends() {
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (!graph_.nodes[n].is_removed && graph_.nodes[n].links.size() == 1) aim_end(n);
        }
    }

    void aim_end(std::uint32_t end) {
        const std::vector<std::uint32_t> path =
            walk_branch(links_in(graph_), end, graph_.nodes[end].links[0]);
        const auto at = [&](std::size_t i) -> Vec3& { return graph_.nodes[path[i]].position; };
        const auto away = [&](std::size_t from, std::size_t to) {
            return static_cast<double>(glm::distance(at(from), at(to)));
        };
        const auto radius = [&](std::size_t i) {
            return static_cast<double>(query_.nearest(at(i)).distance);
        };
        std::size_t base = 1;
        while (base + 1 < path.size() && away(base, 0) < options_.aim_radii * radius(base)) ++base;
        std::size_t behind = base + 1;
        while (behind + 1 < path.size() && away(behind, base) < radius(base)) ++behind;
        if (behind >= path.size() || !(away(behind, base) > 0.0)) return;
        const Vec3 ahead = glm::normalize(at(base) - at(behind));
        const double now = away(base, 0);
        const auto way = static_cast<double>(query_.free_way(at(base), ahead));
        const double length = way - options_.tip_gap_radii * std::min(radius(base), way);
        if (length < options_.aim_least * now || way > now + radius(base)) return;
        const Vec3 start = at(base);
        for (std::size_t i = 0; i < base; ++i)
            at(i) = start + ahead * static_cast<float>(length * static_cast<double>(base - i) /
                                                       static_cast<double>(base));
    }

    // A point of the branch two nodes on from `n` over its neighbour `next`.
    const Vec3& ahead_of(std::uint32_t n, std::uint32_t next) const {
        const auto& links = graph_.nodes[next].links;
        if (links.size() != 2) return graph_.nodes[next].position;
        return graph_.nodes[links[0] == n ? links[1] : links[0]].position;
    }

    void move(const std::vector<std::pair<std::uint32_t, Vec3>>& targets) {
        for (const auto& [n, target] : targets) {
            Node& node = graph_.nodes[n];
            const Vec3& to = target;
            const bool stays =
                std::all_of(node.links.begin(), node.links.end(), [&](std::uint32_t other) {
                    return free_between(graph_.nodes[other].position, to);
                });
            if (stays) node.position = to;
        }
    }

    CurveGraph& graph_;
    std::span<const Vec3> seed_points_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
    std::vector<float> centring_;  // of every node: share of the way that a sweep takes
    RefineReport report_;
};

}  // namespace

CurveGraph build_graph(const ClusterContext& context, std::span<const Connection> connections,
                       const Limbs& limbs) {
    CurveGraph graph;
    std::vector<std::uint32_t> number(limbs.home.size(), kNone);
    for (std::uint32_t c = 0; c < limbs.home.size(); ++c) {
        if (limbs.home[c] != c) continue;
        number[c] = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.emplace_back().position = context.clusters.centers[c];
    }
    for (std::uint32_t s = 0; s < context.clusters.of_point.size(); ++s) {
        graph.nodes[number[limbs.home[context.clusters.of_point[s]]]].seeds.push_back(s);
    }
    for (const std::uint32_t i : limbs.connections) {
        const Connection& c = connections[i];
        const std::span<const Vec3> within = std::span(c.path).subspan(1, c.path.size() - 2);
        link(graph, add_chain(graph, number[c.a], within), number[c.b]);
    }
    for (const Limbs::Tip& tip : limbs.tips)
        add_chain(graph, number[tip.cluster], std::span(tip.path).subspan(1));
    for (Node& node : graph.nodes) node.radius = context.query.nearest(node.position).distance;
    return graph;
}

RefineReport refine_graph(CurveGraph& graph, std::span<const Vec3> seed_points,
                          const SurfaceQuery& query, const RefineOptions& options) {
    return Refiner(graph, seed_points, query, options).run();
}

}  // namespace zskel
