#include "zskel/skeleton/zip.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <utility>

#include "zskel/skeleton/path.h"

namespace zskel {
namespace {

constexpr float kLeastLeft = 0.5f;  // of a branch with an end, in radii
// Of one branch, how near another is that goes the same way round all handles: within its balls.
constexpr float kSameWayRadii = 0.9f;

using Strand = std::vector<std::uint32_t>;

class Zipper {
  public:
    Zipper(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options)
        : graph_(graph), query_(query), options_(options), radii_(graph.nodes.size(), -1.0f) {}

    // Where two parted farther on, a third may have come along: over all junctions until none is
    // left. Every zip removes a node, so this ends.
    std::size_t run() {
        std::size_t zipped = 0;
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
                while (graph_.nodes[n].links.size() > 2 && zip_at(n)) {
                    ++zipped;
                    has_changed = true;
                }
            }
        }
        return zipped;
    }

  private:
    bool zip_at(std::uint32_t junction) {
        std::vector<std::pair<float, Strand>> strands;  // with their lengths
        for (const std::uint32_t next : graph_.nodes[junction].links) {
            Strand strand = graph_.branch_from(junction, next);
            const float length = graph_.length_along(strand);
            strands.emplace_back(length, std::move(strand));
        }
        std::ranges::stable_sort(strands, std::greater(), &std::pair<float, Strand>::first);
        for (std::size_t a = 0; a < strands.size(); ++a) {
            const Strand& longer = strands[a].second;
            const bool is_ring = longer.back() == junction;
            for (std::size_t b = a + 1; b < strands.size(); ++b) {
                const Strand& shorter = strands[b].second;
                if (!is_ring && zip(longer, shorter)) return true;
                if (zip_past(shorter, longer)) return true;
            }
        }
        return false;
    }

    // Joins the one that goes to where it leaves the one that stays.
    bool zip(const Strand& stays, const Strand& goes) {
        const Places places = side_by_side(stays, goes, static_cast<float>(options_.zip_radii));
        if (places.last == 0 || places.beside == 0) return false;
        const Vec3& start = graph_.at(stays.front());
        const std::uint32_t joint = stays[places.beside];
        const float least = static_cast<float>(options_.zip_least_radii) * radius_at(stays.front());
        if (glm::distance(start, graph_.at(joint)) < least) return false;
        return join(goes, places.last, joint);
    }

    // Where the longer of two goes the other's way to the junction at which that ends, however
    // near, it is joined there: it may go on beside what begins there.
    bool zip_past(const Strand& stays, const Strand& goes) {
        const std::uint32_t junction = stays.back();
        const bool is_round =
            goes.back() == junction || goes.back() == goes.front() || junction == stays.front();
        if (graph_.nodes[junction].links.size() < 3 || is_round) return false;
        const Places places = side_by_side(stays, goes, kSameWayRadii);
        if (places.at_end == 0) return false;
        const Vec3& there = graph_.at(junction);
        std::size_t last = places.at_end;
        for (std::size_t k = last + 1; k <= places.last; ++k) {
            if (glm::distance(graph_.at(goes[k]), there) <
                glm::distance(graph_.at(goes[last]), there))
                last = k;
        }
        const float near = static_cast<float>(options_.zip_radii) * radius_at(junction);
        return glm::distance(graph_.at(goes[last]), there) <= near && join(goes, last, junction);
    }

    // Takes a strand off up to its node `last`, and joins what is left of it.
    bool join(const Strand& goes, std::size_t last, std::uint32_t joint) {
        const std::uint32_t next = goes[last + 1];
        // An end that lies beside another branch stays as it is.
        const bool has_end = graph_.nodes[goes.back()].links.size() == 1;
        const Strand left(goes.begin() + static_cast<std::ptrdiff_t>(last), goes.end());
        if (has_end && graph_.length_along(left) < kLeastLeft * radius_at(joint)) return false;
        const auto& kept = graph_.nodes[joint].links;
        const bool is_double =
            next == joint || std::find(kept.begin(), kept.end(), next) != kept.end();
        if (is_double || !query_.sees(graph_.at(joint), graph_.at(next))) return false;
        for (std::size_t k = 0; k <= last; ++k) graph_.unlink(goes[k], goes[k + 1]);
        for (std::size_t k = 1; k <= last; ++k) graph_.give_up(goes[k], joint);
        graph_.link(joint, next);
        return true;
    }

    // Inscribed; nothing moves here.
    float radius_at(std::uint32_t node) {
        float& radius = radii_[node];
        if (radius < 0.0f) radius = query_.nearest(graph_.at(node)).distance;
        return radius;
    }

    struct Places {
        std::size_t last = 0;    // of `goes`, still beside
        std::size_t beside = 0;  // of `stays`, nearest to it
        std::size_t at_end = 0;  // of `goes`, the first beside the last segment of `stays`
    };

    // How far two strands go side by side, in radii; neither to its last node.
    Places side_by_side(const Strand& stays, const Strand& goes, float radii) {
        Places out;
        std::size_t i = 0;
        for (std::size_t k = 1; k + 1 < goes.size(); ++k) {
            const Vec3& p = graph_.at(goes[k]);
            while (i + 2 < stays.size() && glm::distance(p, graph_.at(stays[i + 1])) <=
                                               glm::distance(p, graph_.at(stays[i])))
                ++i;
            const std::array round{graph_.at(stays[i > 0 ? i - 1 : 0]), graph_.at(stays[i]),
                                   graph_.at(stays[i + 1])};
            if (distance_to(std::span(round).subspan(i > 0 ? 0 : 1), p) >
                radii * radius_at(goes[k]))
                break;
            out.last = k;
            out.beside = i;
            if (out.at_end == 0 && i + 2 >= stays.size()) out.at_end = k;
        }
        return out;
    }

    CurveGraph& graph_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
    std::vector<float> radii_;  // below 0: not looked at yet
};

}  // namespace

std::size_t zip_branches(CurveGraph& graph, const SurfaceQuery& query,
                         const RefineOptions& options) {
    return Zipper(graph, query, options).run();
}

}  // namespace zskel
