#include "zskel/skeleton/junctions.h"

#include <algorithm>
#include <utility>

namespace zskel {
namespace {

class JunctionMerger {
  public:
    JunctionMerger(CurveGraph& graph, const SurfaceQuery& query, double merge_radii)
        : graph_(graph), query_(query), merge_radii_(merge_radii) {}

    std::size_t run() {
        std::size_t merged = 0;
        bool changed = true;
        while (changed) {
            changed = false;
            for (const std::vector<std::uint32_t>& branch : graph_.branches()) {
                if (branch.front() == branch.back()) continue;
                if (graph_.nodes[branch.front()].links.size() < 3 ||
                    graph_.nodes[branch.back()].links.size() < 3)
                    continue;
                if (try_merge(branch)) {
                    ++merged;
                    changed = true;
                    break;
                }
            }
        }
        return merged;
    }

  private:
    bool try_merge(const std::vector<std::uint32_t>& branch) {
        std::uint32_t keep = branch.front();
        std::uint32_t drop = branch.back();
        if (graph_.nodes[keep].radius < graph_.nodes[drop].radius) std::swap(keep, drop);
        const double bound = merge_radii_ * static_cast<double>(graph_.nodes[keep].radius);
        if (static_cast<double>(graph_.length_along(branch)) >= bound) return false;
        const std::uint32_t last = drop == branch.back() ? branch[branch.size() - 2] : branch[1];
        std::vector<std::uint32_t> moved = graph_.nodes[drop].links;
        moved.erase(std::find(moved.begin(), moved.end(), last));
        for (const std::uint32_t n : moved) {
            const auto& kept = graph_.nodes[keep].links;
            const bool is_double =
                n == keep || std::find(kept.begin(), kept.end(), n) != kept.end();
            if (is_double || !query_.sees(graph_.at(n), graph_.at(keep))) return false;
        }
        for (std::size_t i = 1; i < branch.size(); ++i) graph_.unlink(branch[i - 1], branch[i]);
        for (const std::uint32_t n : branch) {
            if (n != keep) graph_.give_up(n, keep);
        }
        for (const std::uint32_t n : moved) {
            graph_.unlink(n, drop);
            graph_.link(n, keep);
        }
        return true;
    }

    CurveGraph& graph_;
    const SurfaceQuery& query_;
    double merge_radii_;
};

}  // namespace

std::size_t merge_junctions(CurveGraph& graph, const SurfaceQuery& query, double merge_radii) {
    return JunctionMerger(graph, query, merge_radii).run();
}

}  // namespace zskel
