#include "zskel/mesh/orient.h"

#include <algorithm>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/sides.h"

namespace zskel {
namespace {

// Triangles that hang together, each with whether it has to be turned to agree with the lowest.
class TurnedSets {
  public:
    explicit TurnedSets(std::size_t count) {
        links_.reserve(count);
        for (std::uint32_t t = 0; t < count; ++t) links_.push_back(t << 1);
    }

    struct Found {
        std::uint32_t lowest;
        bool turned;
    };
    Found find(std::uint32_t t) {
        bool turned = false;
        while (links_[t] >> 1 != t) {
            links_[t] = links_[links_[t] >> 1] ^ (links_[t] & 1);  // halves the way
            turned = turned != ((links_[t] & 1) != 0);
            t = links_[t] >> 1;
        }
        return {t, turned};
    }

    // False when they already hang together the other way round.
    bool unite(std::uint32_t t, std::uint32_t u, bool turn) {
        Found a = find(t);
        Found b = find(u);
        if (a.lowest == b.lowest) return (a.turned != b.turned) == turn;
        if (b.lowest < a.lowest) std::swap(a, b);
        links_[b.lowest] = a.lowest << 1 | ((a.turned != b.turned) != turn ? 1u : 0u);
        return true;
    }

  private:
    std::vector<std::uint32_t> links_;  // towards the lowest; the lowest bit: turned against it
};

// Twice the signed volume over three of every component's triangles, taken from its centroid:
// positive when they face outward, closed or nearly so.
std::vector<double> signed_volumes(const WeldedMesh& mesh, const Orientation& out) {
    std::vector<DVec3> centroids(out.component_count, DVec3(0.0));
    std::vector<double> counts(out.component_count, 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        centroids[out.component[t]] += mesh.positions[mesh.triangles[t].x];
        counts[out.component[t]] += 1.0;
    }
    for (std::size_t c = 0; c < centroids.size(); ++c) centroids[c] /= counts[c];
    std::vector<double> volumes(out.component_count, 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& tri = mesh.triangles[t];
        const DVec3& centroid = centroids[out.component[t]];
        volumes[out.component[t]] += glm::dot(
            mesh.positions[tri.x] - centroid,
            glm::cross(mesh.positions[tri.y] - centroid, mesh.positions[tri.z] - centroid));
    }
    return volumes;
}

// What the edges say of the triangles beside them.
struct Neighbours {
    explicit Neighbours(std::size_t triangles)
        : sets(triangles), touches_odd_edge(triangles, false) {}

    TurnedSets sets;
    std::vector<bool> touches_odd_edge;
    std::vector<std::uint32_t> contradicted;  // triangles at edges where both turns are wrong
};

void meet_neighbours(const std::vector<Side>& sides, Neighbours& met, Orientation& out) {
    // Over edges of more than two faces: which of them turns with which cannot be told.
    std::vector<glm::uvec2> crowd;
    for_each_edge(sides, [&](std::size_t first, std::size_t last) {
        const std::size_t share = last - first;
        out.edges.push_back(sides[first].edge);
        out.open_edges += share == 1 ? 1 : 0;
        out.crowded_edges += share > 2 ? 1 : 0;
        for (std::size_t i = first; i < last && share != 2; ++i)
            met.touches_odd_edge[sides[i].triangle] = true;
        for (std::size_t i = first; i + 1 < last; ++i) {
            const Side& a = sides[i];
            const Side& b = sides[i + 1];
            if (share > 2) {
                crowd.emplace_back(a.triangle, b.triangle);
                continue;
            }
            const bool agrees = a.is_forward != b.is_forward;
            if (!met.sets.unite(a.triangle, b.triangle, !agrees))
                met.contradicted.push_back(a.triangle);
        }
    });
    for (const glm::uvec2& pair : crowd) met.sets.unite(pair.x, pair.y, false);
}

// Whether the triangles at every vertex hang together over edges.
bool has_whole_fans(const std::vector<Side>& sides, const WeldedMesh& mesh) {
    DisjointSets corners(mesh.triangles.size() * 3);
    std::size_t fans = mesh.triangles.size() * 3;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].edge != sides[i - 1].edge) continue;
        fans -= corners.unite(sides[i].low_corner(), sides[i - 1].low_corner()) ? 1 : 0;
        fans -= corners.unite(sides[i].high_corner(), sides[i - 1].high_corner()) ? 1 : 0;
    }
    return fans == mesh.positions.size();
}

}  // namespace

Orientation orient(WeldedMesh& mesh, std::vector<Side> sides, std::vector<Repair>& repairs) {
    Orientation out;
    const std::size_t count = mesh.triangles.size();
    Neighbours neighbours(count);
    // Two walks over all edges, for a thread each.
    parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
        if (begin == 0) meet_neighbours(sides, neighbours, out);
        if (end == 2) out.fans_are_whole = has_whole_fans(sides, mesh);
    });
    sides = {};
    out.component.assign(count, kNone);
    std::vector<std::size_t> sizes;
    std::vector<std::size_t> turns;
    for (std::uint32_t t = 0; t < count; ++t) {
        const TurnedSets::Found found = neighbours.sets.find(t);
        if (found.lowest == t) {
            out.component[t] = out.component_count++;
            out.component_closed.push_back(true);
            out.component_sheet.push_back(false);
            out.component_orientable.push_back(true);
            sizes.push_back(0);
            turns.push_back(0);
        }
        const std::uint32_t c = out.component[t] = out.component[found.lowest];
        if (neighbours.touches_odd_edge[t]) out.component_closed[c] = false;
        ++sizes[c];
        if (!found.turned) continue;
        ++turns[c];
        std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
    }
    for (const std::uint32_t t : neighbours.contradicted)
        out.component_orientable[out.component[t]] = false;
    const std::vector<double> volumes = signed_volumes(mesh, out);
    for (std::size_t t = 0; t < count; ++t) {
        if (volumes[out.component[t]] < 0.0) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
    }
    std::size_t turned_faces = 0;
    std::size_t turned_components = 0;
    for (std::size_t c = 0; c < volumes.size(); ++c) {
        turned_faces += std::min(turns[c], sizes[c] - turns[c]);
        turned_components += volumes[c] < 0.0 && turns[c] * 2 < sizes[c] ? 1 : 0;
    }
    note(repairs, "faces turned to agree with their neighbours", turned_faces);
    note(repairs, "inside-out components turned", turned_components);
    note(repairs,
         "edges where no consistent orientation exists: there, inside and outside are not known",
         neighbours.contradicted.size());
    return out;
}

}  // namespace zskel
