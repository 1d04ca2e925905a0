#include "zskel/skeleton/shell_bridges.h"

#include <algorithm>
#include <tuple>

#include "zskel/skeleton/path.h"

namespace zskel {
namespace {

struct Pair {
    float length;
    std::uint32_t a;
    std::uint32_t b;
};

// Of clusters in different sets, shortest first.
std::vector<Pair> find_pairs(const std::vector<Vec3>& centers, DisjointSets& sets) {
    std::vector<Pair> pairs;
    std::uint32_t apart = 0;
    while (apart < centers.size() && sets.find(apart) == 0) ++apart;
    if (apart == centers.size()) return pairs;
    for (std::uint32_t a = 0; a < centers.size(); ++a) {
        for (std::uint32_t b = a + 1; b < centers.size(); ++b) {
            if (sets.find(a) != sets.find(b))
                pairs.push_back({glm::distance(centers[a], centers[b]), a, b});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& l, const Pair& r) {
        return std::tie(l.length, l.a, l.b) < std::tie(r.length, r.a, r.b);
    });
    return pairs;
}

}  // namespace

void bridge_shells(const ClusterContext& context, DisjointSets& sets, ClusterNetwork& network) {
    const std::vector<Vec3>& centers = context.clusters.centers;
    const std::vector<Pair> pairs = find_pairs(centers, sets);
    for (const bool must_be_free : {true, false}) {
        for (const Pair& pair : pairs) {
            if (sets.find(pair.a) == sets.find(pair.b)) continue;
            const std::vector<Vec3> path{centers[pair.a], centers[pair.b]};
            if (must_be_free && !is_free(path, context.query)) continue;
            sets.unite(pair.a, pair.b);
            network.spanning.push_back(static_cast<std::uint32_t>(network.connections.size()));
            network.connections.push_back({pair.a, pair.b, 0, 0, path, pair.length, must_be_free});
        }
    }
}

}  // namespace zskel
