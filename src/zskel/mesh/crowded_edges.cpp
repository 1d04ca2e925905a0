#include "zskel/mesh/crowded_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/mesh/outlook.h"
#include "zskel/mesh/sides.h"
#include "zskel/mesh/signed_volume.h"

namespace zskel {
namespace {

constexpr double kLargestFin = 0.1;  // of the area of what it hangs on to
constexpr double kUnseen = 0.01;     // share of rays from a wall that may yet leave
constexpr int kMostRounds = 8;       // of dropping: what is dropped may loosen the next

// The triangles in patches, and the edges that are crowded.
struct Patches {
    std::vector<Side> sides;
    std::vector<std::pair<std::size_t, std::size_t>> crowded;  // runs of `sides`
    std::vector<std::uint32_t> of_triangle;
    std::vector<double> area;
    std::vector<bool> is_loose;       // has an edge with one triangle
    std::vector<double> joined_area;  // of all patches that it hangs together with

    explicit Patches(const WeldedMesh& mesh)
        : sides(sorted_sides(mesh.triangles, mesh.positions.size())) {
        const std::size_t count = mesh.triangles.size();
        DisjointSets patches(count);
        DisjointSets parts(count);
        std::vector<std::uint32_t> loose;
        for_each_edge(sides, [&](std::size_t first, std::size_t last) {
            if (last - first == 1) loose.push_back(sides[first].triangle);
            if (last - first > 2) crowded.emplace_back(first, last);
            if (last - first == 2) patches.unite(sides[first].triangle, sides[first + 1].triangle);
            for (std::size_t i = first + 1; i < last; ++i)
                parts.unite(sides[first].triangle, sides[i].triangle);
        });
        of_triangle.resize(count);
        std::vector<double> part_area(count, 0.0);
        for (std::uint32_t t = 0; t < count; ++t) {
            const std::uint32_t lowest = patches.find(t);
            if (lowest == t) {
                of_triangle[t] = static_cast<std::uint32_t>(area.size());
                area.push_back(0.0);
            }
            of_triangle[t] = of_triangle[lowest];
            const Triangle& c = mesh.triangles[t];
            const double size = glm::length(glm::cross(mesh.positions[c.y] - mesh.positions[c.x],
                                                       mesh.positions[c.z] - mesh.positions[c.x]));
            area[of_triangle[t]] += size;
            part_area[parts.find(t)] += size;
        }
        is_loose.assign(area.size(), false);
        for (const std::uint32_t t : loose) is_loose[of_triangle[t]] = true;
        joined_area.assign(area.size(), 0.0);
        for (std::uint32_t t = 0; t < count; ++t)
            joined_area[of_triangle[t]] = part_area[parts.find(t)];
    }

    // Leaves the candidates out that no crowded edge needs: two others stay there at least, or none
    // but candidates meet there.
    std::size_t drop(WeldedMesh& mesh, std::vector<bool> is_candidate) const {
        std::vector<bool> touches(area.size(), false);
        for (const auto& [first, last] : crowded) {
            std::size_t others = 0;
            for (std::size_t i = first; i < last; ++i)
                others += is_candidate[of_triangle[sides[i].triangle]] ? 0 : 1;
            for (std::size_t i = first; i < last; ++i) {
                const std::uint32_t patch = of_triangle[sides[i].triangle];
                touches[patch] = true;
                if (others == 1) is_candidate[patch] = false;
            }
        }
        std::vector<bool> dropped(of_triangle.size(), false);
        std::size_t count = 0;
        for (std::size_t t = 0; t < dropped.size(); ++t) {
            dropped[t] = is_candidate[of_triangle[t]] && touches[of_triangle[t]];
            count += dropped[t] ? 1 : 0;
        }
        if (count > 0) drop_triangles(mesh, dropped);
        return count;
    }
};

std::size_t drop_fins(WeldedMesh& mesh) {
    std::size_t count = 0;
    for (int round = 0; round < kMostRounds; ++round) {
        const Patches patches(mesh);
        if (patches.crowded.empty()) break;
        std::vector<bool> is_fin(patches.area.size());
        for (std::size_t p = 0; p < is_fin.size(); ++p)
            is_fin[p] =
                patches.is_loose[p] && patches.area[p] <= kLargestFin * patches.joined_area[p];
        const std::size_t dropped = patches.drop(mesh, is_fin);
        count += dropped;
        if (dropped == 0) break;
    }
    return count;
}

std::size_t drop_walls(WeldedMesh& mesh) {
    const Patches patches(mesh);
    std::vector<bool> is_odd(patches.area.size(), false);  // at an edge that cannot be paired
    for (const auto& [first, last] : patches.crowded) {
        for (std::size_t i = first; i < last && (last - first) % 2 == 1; ++i)
            is_odd[patches.of_triangle[patches.sides[i].triangle]] = true;
    }
    if (std::find(is_odd.begin(), is_odd.end(), true) == is_odd.end()) return 0;
    const std::vector<Outlook> views = look_out(mesh, patches.of_triangle, patches.area.size());
    std::vector<bool> is_wall(patches.area.size());
    for (std::size_t p = 0; p < is_wall.size(); ++p) {
        is_wall[p] = is_odd[p] && !patches.is_loose[p] && views[p].front <= kUnseen &&
                     views[p].back <= kUnseen;
    }
    return patches.drop(mesh, is_wall);
}

// The triangles round an edge by the angle that they stand at.
std::vector<std::pair<double, std::size_t>> round_edge(const WeldedMesh& mesh,
                                                       const std::vector<Side>& sides,
                                                       std::size_t first, std::size_t last) {
    const DVec3& a = mesh.positions[sides[first].edge.x];
    const DVec3 along = glm::normalize(mesh.positions[sides[first].edge.y] - a);
    const DVec3 across = std::abs(along.x) < 0.5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    const DVec3 u = glm::normalize(glm::cross(along, across));
    const DVec3 v = glm::cross(along, u);
    std::vector<std::pair<double, std::size_t>> out;
    for (std::size_t i = first; i < last; ++i) {
        const Side& side = sides[i];
        const DVec3 away = mesh.positions[mesh.triangles[side.triangle][(side.corner + 2) % 3]] - a;
        out.emplace_back(std::atan2(glm::dot(away, v), glm::dot(away, u)), i);
    }
    std::sort(out.begin(), out.end());
    return out;
}

using SidePairs = std::vector<std::pair<std::size_t, std::size_t>>;

// Pairs of sides at a crowded edge; none where their number is odd.
// @param is_turned  the triangles' fronts are inside.
SidePairs pairs_at(const WeldedMesh& mesh, const Patches& patches, bool is_turned,
                   std::size_t first, std::size_t last) {
    if ((last - first) % 2 == 1) return {};
    std::map<std::uint32_t, std::vector<std::size_t>> by_patch;
    for (std::size_t i = first; i < last; ++i)
        by_patch[patches.of_triangle[patches.sides[i].triangle]].push_back(i);
    SidePairs pairs;
    for (const auto& [patch, members] : by_patch) {
        if (members.size() == 2) pairs.emplace_back(members[0], members[1]);
    }
    if (2 * pairs.size() == last - first) return pairs;
    const auto round = round_edge(mesh, patches.sides, first, last);
    const auto wedges = [&](std::size_t start) {
        double sum = 0.0;
        for (std::size_t i = start; i < start + round.size(); i += 2) {
            const double wedge =
                round[(i + 1) % round.size()].first - round[i % round.size()].first;
            sum += wedge < 0.0 ? wedge + 2.0 * std::numbers::pi : wedge;
        }
        return sum;
    };
    // Where fronts and backs take turns, the pairs are those with the solid between them; a side
    // that runs backward along the edge has it at the larger angles.
    const auto opens = [&](std::size_t i) {
        return patches.sides[round[i % round.size()].second].is_forward == is_turned;
    };
    bool takes_turns = true;
    for (std::size_t i = 0; i < round.size(); ++i)
        takes_turns = takes_turns && opens(i) != opens(i + 1);
    const bool is_second = takes_turns ? !opens(0) : wedges(1) < wedges(0);
    const std::size_t start = is_second ? 1 : 0;
    pairs.clear();
    for (std::size_t i = start; i < start + round.size(); i += 2)
        pairs.emplace_back(round[i % round.size()].second, round[(i + 1) % round.size()].second);
    return pairs;
}

std::uint32_t add_place(WeldedMesh& mesh, DVec3 there, std::uint32_t vertex) {
    mesh.positions.push_back(there);
    mesh.vertex.push_back(vertex);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// Cuts triangles at the middles of their sides. @param middle  of every side, as 3 x triangle +
// corner: a place there, or kNone.
void cut_sides(WeldedMesh& mesh, const std::vector<std::uint32_t>& middle) {
    std::vector<std::uint32_t> round;  // corners and middles of a triangle
    for (std::size_t t = 0; t < middle.size() / 3; ++t) {
        round.clear();
        std::ptrdiff_t at_middle = 0;
        for (int k = 0; k < 3; ++k) {
            round.push_back(mesh.triangles[t][k]);
            const std::uint32_t place = middle[3 * t + static_cast<std::size_t>(k)];
            if (place == kNone) continue;
            at_middle = std::ssize(round);
            round.push_back(place);
        }
        if (round.size() == 3) continue;
        std::rotate(round.begin(), round.begin() + at_middle, round.end());
        mesh.triangles[t] = {round[0], round[1], round[2]};
        for (std::size_t k = 3; k < round.size(); ++k) {
            mesh.triangles.emplace_back(round[0], round[k - 1], round[k]);
            mesh.input_triangle.push_back(mesh.input_triangle[t]);
        }
    }
}

// Pairs of an edge whose fans are the same at both ends would go on being one edge: each gets a
// middle of its own. Of every side, as cut_sides takes it.
std::vector<std::uint32_t> middles_of_alike(WeldedMesh& mesh, const Patches& patches,
                                            const std::vector<SidePairs>& paired,
                                            DisjointSets& fans) {
    std::vector<std::uint32_t> middle(mesh.triangles.size() * 3, kNone);
    const auto ends_of = [&](const Side& side) {
        return std::pair(fans.find(side.low_corner()), fans.find(side.high_corner()));
    };
    for (const SidePairs& pairs : paired) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> alike;
        for (const auto& pair : pairs) ++alike[ends_of(patches.sides[pair.first])];
        for (const auto& [i, k] : pairs) {
            const Side& one = patches.sides[i];
            const Side& other = patches.sides[k];
            if (alike[ends_of(one)] == 1) continue;
            const DVec3 there = 0.5 * mesh.positions[one.edge.x] + 0.5 * mesh.positions[one.edge.y];
            const std::uint32_t place = add_place(mesh, there, mesh.vertex[one.edge.x]);
            middle[3 * one.triangle + one.corner] = place;
            middle[3 * other.triangle + other.corner] = place;
        }
    }
    return middle;
}

// Gives each fan of triangles at the crowded edges' places a place of its own; the number of edges
// that were paired.
std::size_t part_pairs(WeldedMesh& mesh) {
    const Patches patches(mesh);
    DisjointSets fans(mesh.triangles.size() * 3);
    const auto unite = [&](std::size_t i, std::size_t k) {
        fans.unite(patches.sides[i].low_corner(), patches.sides[k].low_corner());
        fans.unite(patches.sides[i].high_corner(), patches.sides[k].high_corner());
    };
    std::vector<bool> is_at_crowd(mesh.positions.size(), false);
    const bool is_turned = signed_volume(mesh.positions, mesh.triangles) < 0.0;
    std::vector<SidePairs> paired;
    for_each_edge(patches.sides, [&](std::size_t first, std::size_t last) {
        if (last - first == 2) unite(first, first + 1);
        if (last - first <= 2) return;
        SidePairs pairs = pairs_at(mesh, patches, is_turned, first, last);
        for (const auto& [i, k] : pairs) unite(i, k);
        for (std::size_t i = first + 1; i < last && pairs.empty(); ++i) unite(first, i);
        if (!pairs.empty()) paired.push_back(std::move(pairs));
        is_at_crowd[patches.sides[first].edge.x] = true;
        is_at_crowd[patches.sides[first].edge.y] = true;
    });
    const std::vector<std::uint32_t> middle = middles_of_alike(mesh, patches, paired, fans);
    std::vector<bool> is_taken(is_at_crowd.size(), false);
    std::vector<std::uint32_t> of_fan(mesh.triangles.size() * 3, kNone);
    for (std::uint32_t corner = 0; corner < of_fan.size(); ++corner) {
        std::uint32_t& place = mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
        if (place >= is_at_crowd.size() || !is_at_crowd[place]) continue;
        std::uint32_t& own = of_fan[fans.find(corner)];
        if (own == kNone)
            own = is_taken[place] ? add_place(mesh, mesh.positions[place], mesh.vertex[place])
                                  : place;
        is_taken[place] = true;
        place = own;
    }
    cut_sides(mesh, middle);
    return paired.size();
}

}  // namespace

void mend_crowded_edges(WeldedMesh& mesh, std::vector<Repair>& repairs) {
    note(repairs, "faces left out that hang loose from an edge with two others", drop_fins(mesh));
    note(repairs, "faces left out that part what is one inside", drop_walls(mesh));
    note(repairs, "non-manifold edges parted", part_pairs(mesh));
    keep_used_places(mesh);
}

}  // namespace zskel
