#include "zskel/skeleton/shell_bridges.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "zskel/core/lattice_hash.h"
#include "zskel/mesh/bounds.h"
#include "zskel/skeleton/path.h"

namespace zskel {
namespace {

struct Pair {
    float length;
    std::uint32_t a;
    std::uint32_t b;
};

std::size_t count_of(DisjointSets& sets, std::size_t clusters) {
    std::size_t count = 0;
    for (std::uint32_t c = 0; c < clusters; ++c) count += sets.find(c) == c ? 1 : 0;
    return count;
}

// Of clusters in different sets, those longer than one distance and no longer than another,
// shortest first.
std::vector<Pair> find_pairs(const std::vector<Vec3>& centers, DisjointSets& sets, double over,
                             double most) {
    std::unordered_map<glm::i64vec3, std::vector<std::uint32_t>, LatticeHash> cells;
    std::vector<Pair> pairs;
    for (std::uint32_t b = 0; b < centers.size(); ++b) {
        const glm::i64vec3 cell = cell_of(centers[b], most);
        for (int n = 0; n < 27; ++n) {
            const auto found = cells.find(cell + glm::i64vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            if (found == cells.end()) continue;
            for (const std::uint32_t a : found->second) {
                const float length = glm::distance(centers[a], centers[b]);
                const auto exact = static_cast<double>(length);
                if (exact > over && exact <= most && sets.find(a) != sets.find(b))
                    pairs.push_back({length, a, b});
            }
        }
        cells[cell].push_back(b);
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& l, const Pair& r) {
        return std::tie(l.length, l.a, l.b) < std::tie(r.length, r.a, r.b);
    });
    return pairs;
}

}  // namespace

void bridge_shells(const ClusterContext& context, DisjointSets& sets, ClusterNetwork& network) {
    const std::vector<Vec3>& centers = context.clusters.centers;
    std::size_t apart = count_of(sets, centers.size());
    if (apart < 2) return;
    // More than any two are apart, in single precision too, and not 0 where all are at one place.
    const double farthest = 1.01 * box_of(centers).diagonal() + 1e-6;
    for (const bool must_be_free : {true, false}) {
        double over = -1.0;
        double most = farthest / std::cbrt(static_cast<double>(centers.size()));
        for (; apart > 1 && over < farthest; over = std::exchange(most, 2.0 * most)) {
            for (const Pair& pair : find_pairs(centers, sets, over, most)) {
                if (sets.find(pair.a) == sets.find(pair.b)) continue;
                const std::vector<Vec3> path{centers[pair.a], centers[pair.b]};
                if (must_be_free && !is_free(path, context.query)) continue;
                sets.unite(pair.a, pair.b);
                --apart;
                network.spanning.push_back(static_cast<std::uint32_t>(network.connections.size()));
                network.connections.push_back(
                    {pair.a, pair.b, 0, 0, path, pair.length, must_be_free});
            }
        }
    }
}

}  // namespace zskel
