#include "zskel/skeleton/zip.h"

#include <algorithm>

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
        : graph_(graph), query_(query), options_(options) {}

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
        std::vector<Strand> strands;
        for (const std::uint32_t next : graph_.nodes[junction].links)
            strands.push_back(graph_.branch_from(junction, next));
        std::stable_sort(strands.begin(), strands.end(), [&](const Strand& a, const Strand& b) {
            return graph_.length_along(a) > graph_.length_along(b);
        });
        for (std::size_t a = 0; a < strands.size(); ++a) {
            for (std::size_t b = a + 1; b < strands.size(); ++b) {
                const bool is_ring = strands[a].back() == junction;
                if (!is_ring && zip(strands[a], strands[b])) return true;
                if (zip_past(strands[b], strands[a])) return true;
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
        const float least =
            static_cast<float>(options_.zip_least_radii) * query_.nearest(start).distance;
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
        const float near = static_cast<float>(options_.zip_radii) * query_.nearest(there).distance;
        return glm::distance(graph_.at(goes[last]), there) <= near && join(goes, last, junction);
    }

    // Takes a strand off up to its node `last`, and joins what is left of it.
    bool join(const Strand& goes, std::size_t last, std::uint32_t joint) {
        const std::uint32_t next = goes[last + 1];
        // An end that lies beside another branch stays as it is.
        const bool has_end = graph_.nodes[goes.back()].links.size() == 1;
        const Strand left(goes.begin() + static_cast<std::ptrdiff_t>(last), goes.end());
        const float radius = query_.nearest(graph_.at(joint)).distance;
        if (has_end && graph_.length_along(left) < kLeastLeft * radius) return false;
        const auto& kept = graph_.nodes[joint].links;
        const bool is_double =
            next == joint || std::find(kept.begin(), kept.end(), next) != kept.end();
        if (is_double || !query_.sees(graph_.at(joint), graph_.at(next))) return false;
        for (std::size_t k = 0; k <= last; ++k) graph_.unlink(goes[k], goes[k + 1]);
        for (std::size_t k = 1; k <= last; ++k) graph_.give_up(goes[k], joint);
        graph_.link(joint, next);
        return true;
    }

    struct Places {
        std::size_t last = 0;    // of `goes`, still beside
        std::size_t beside = 0;  // of `stays`, nearest to it
        std::size_t at_end = 0;  // of `goes`, the first beside the last segment of `stays`
    };

    // How far two strands go side by side, in radii; neither to its last node.
    Places side_by_side(const Strand& stays, const Strand& goes, float radii) const {
        Places out;
        std::size_t i = 0;
        for (std::size_t k = 1; k + 1 < goes.size(); ++k) {
            const Vec3& p = graph_.at(goes[k]);
            while (i + 2 < stays.size() && glm::distance(p, graph_.at(stays[i + 1])) <=
                                               glm::distance(p, graph_.at(stays[i])))
                ++i;
            const float aside = distance_to(points_round(stays, i), p);
            if (aside > radii * query_.nearest(p).distance) break;
            out.last = k;
            out.beside = i;
            if (out.at_end == 0 && i + 2 >= stays.size()) out.at_end = k;
        }
        return out;
    }

    // A node's place between those before and after it.
    std::vector<Vec3> points_round(const Strand& strand, std::size_t i) const {
        std::vector<Vec3> points;
        for (std::size_t k = i > 0 ? i - 1 : 0; k <= i + 1; ++k)
            points.push_back(graph_.at(strand[k]));
        return points;
    }

    CurveGraph& graph_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
};

}  // namespace

std::size_t zip_branches(CurveGraph& graph, const SurfaceQuery& query,
                         const RefineOptions& options) {
    return Zipper(graph, query, options).run();
}

}  // namespace zskel
