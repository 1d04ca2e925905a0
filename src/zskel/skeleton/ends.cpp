#include "zskel/skeleton/ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "zskel/core/across.h"

namespace zskel {
namespace {

constexpr std::size_t kRings = 4;  // of the cone that an end is aimed in,
constexpr std::size_t kRingRays = 12;
constexpr double kConeAngle = 0.25 * std::numbers::pi;

class EndExtender {
  public:
    EndExtender(CurveGraph& graph, std::span<const Vec3> seed_points, const SurfaceQuery& query,
                const RefineOptions& options)
        : graph_(graph), seed_points_(seed_points), query_(query), options_(options) {}

    std::size_t extend() {
        const std::size_t count = graph_.nodes.size();
        for (std::uint32_t n = 0; n < count; ++n) {
            const CurveGraph::Node& node = graph_.nodes[n];
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
        return extended_;
    }

  private:
    // A point of the branch about one radius back from its end.
    Vec3 before_end(std::uint32_t end) const {
        const std::vector<std::uint32_t> path = graph_.branch_from(end, graph_.nodes[end].links[0]);
        std::size_t i = 1;
        while (i + 1 < path.size() &&
               glm::distance(graph_.at(path[i]), graph_.at(end)) < graph_.nodes[end].radius) {
            ++i;
        }
        return graph_.at(path[i]);
    }

    void extend_to(std::uint32_t n, const Vec3& tip) {
        const Vec3 from = graph_.at(n);
        const float gap = static_cast<float>(options_.tip_gap_radii) * graph_.nodes[n].radius;
        const float distance = glm::distance(tip, from);
        if (distance <= 1.5f * gap) return;
        const Vec3 end = from + (tip - from) * (1.0f - gap / distance);
        if (!query_.sees(from, end)) return;
        graph_.link(n, graph_.add(end, query_.nearest(end).distance));
        ++extended_;
    }

    CurveGraph& graph_;
    std::span<const Vec3> seed_points_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
    std::size_t extended_ = 0;
};

class EndAimer {
  public:
    EndAimer(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options)
        : graph_(graph), query_(query), options_(options) {}

    void aim() {
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (!graph_.nodes[n].is_removed && graph_.nodes[n].links.size() == 1) aim_end(n);
        }
    }

  private:
    // From a place towards the centroid of what it sees in a cone ahead: an end that bends is
    // followed, a straight one left as it is.
    Vec3 towards_middle(const Vec3& from, const Vec3& ahead) const {
        const DVec3 along(ahead);
        const Across across(along);
        std::array<Vec3, kRings * kRingRays> rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::size_t ring = i / kRingRays;
            const double off = kConeAngle * (static_cast<double>(ring) + 0.5) / kRings;
            const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / kRingRays;
            rays[i] = Vec3(along * std::cos(off) + across.at(turn) * std::sin(off));
        }
        std::array<float, rays.size()> ways{};
        query_.free_ways(from, rays, ways);
        DVec3 sum(0.0);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (ways[i] >= SurfaceQuery::kFarthest) continue;  // out through an opening
            const double off = glm::length(glm::cross(DVec3(rays[i]), along));
            sum += DVec3(rays[i]) * (off * std::pow(static_cast<double>(ways[i]), 4));
        }
        return glm::length(sum) > 0.0 ? Vec3(glm::normalize(sum)) : ahead;
    }

    void aim_end(std::uint32_t end) {
        const std::vector<std::uint32_t> path = graph_.branch_from(end, graph_.nodes[end].links[0]);
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
        const Vec3 ahead = towards_middle(at(base), glm::normalize(at(base) - at(behind)));
        const double now = away(base, 0);
        const auto way = static_cast<double>(query_.free_way(at(base), ahead));
        const double length = way - options_.tip_gap_radii * std::min(radius(base), way);
        if (length < options_.aim_least * now || way > now + radius(base)) return;
        const Vec3 start = at(base);
        for (std::size_t i = 0; i < base; ++i)
            at(i) = start + ahead * static_cast<float>(length * static_cast<double>(base - i) /
                                                       static_cast<double>(base));
    }

    CurveGraph& graph_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
};

}  // namespace

std::size_t extend_ends(CurveGraph& graph, std::span<const Vec3> seed_points,
                        const SurfaceQuery& query, const RefineOptions& options) {
    return EndExtender(graph, seed_points, query, options).extend();
}

void aim_ends(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options) {
    EndAimer(graph, query, options).aim();
}

}  // namespace zskel
