#include "zskel/mesh/cracks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <unordered_map>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/lattice_hash.h"
#include "zskel/mesh/sides.h"

namespace zskel {
namespace {

constexpr double kShareOfEdge = 0.25;
constexpr double kLeastReach = 1e-9;   // of the tolerance
constexpr int kMostRounds = 4;         // of splitting: a triangle's sides one after the other
constexpr double kMostCells = 4096.0;  // looked at along one edge

std::vector<Side> boundary_sides(const WeldedMesh& mesh) {
    const std::vector<Side> all = sorted_sides(mesh.triangles, mesh.positions.size());
    std::vector<Side> boundary;
    for_each_edge(all, [&](std::size_t first, std::size_t last) {
        if (last - first == 1) boundary.push_back(all[first]);
    });
    return boundary;
}

// The places on the boundary, found by where they are.
class PlaceGrid {
  public:
    PlaceGrid(const WeldedMesh& mesh, const std::vector<std::uint32_t>& places, double cell)
        : cell_(cell) {
        for (const std::uint32_t p : places) cells_[cell_of(mesh.positions[p], cell_)].push_back(p);
    }

    /// All within a cell's length of a point, and some beyond.
    template <typename Visit>
    void near(const DVec3& point, const Visit& visit) const {
        const glm::i64vec3 middle = cell_of(point, cell_);
        for (int n = 0; n < 27; ++n) {
            const auto found =
                cells_.find(middle + glm::i64vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            if (found == cells_.end()) continue;
            for (const std::uint32_t p : found->second) visit(p);
        }
    }

  private:
    double cell_;
    std::unordered_map<glm::i64vec3, std::vector<std::uint32_t>, LatticeHash> cells_;
};

std::vector<std::uint32_t> places_on(const std::vector<Side>& boundary) {
    std::vector<std::uint32_t> places;
    for (const Side& side : boundary) {
        places.push_back(side.edge.x);
        places.push_back(side.edge.y);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

double length_of(const WeldedMesh& mesh, const glm::uvec2& edge) {
    return glm::distance(mesh.positions[edge.x], mesh.positions[edge.y]);
}

std::size_t weld_boundary(WeldedMesh& mesh, const std::vector<Side>& boundary, double tolerance) {
    const std::vector<std::uint32_t> places = places_on(boundary);
    std::vector<double> reach(mesh.positions.size(), tolerance);
    for (const Side& side : boundary) {
        const double length =
            std::max(kShareOfEdge * length_of(mesh, side.edge), kLeastReach * tolerance);
        for (const std::uint32_t p : {side.edge.x, side.edge.y})
            reach[p] = std::min(reach[p], length);
    }
    DisjointSets sets(mesh.positions.size());
    std::size_t merged = 0;
    // Of two places the one with the shorter reach finds the other. Reaches that halve have grids
    // of their own: in one for all a small part of a wide model would be a single cell.
    std::vector<std::uint32_t> searching = places;
    for (double cell = tolerance; !searching.empty(); cell *= 0.5) {
        std::vector<std::uint32_t> shorter;
        std::vector<std::uint32_t> here;
        for (const std::uint32_t p : searching)
            (reach[p] <= 0.5 * cell ? shorter : here).push_back(p);
        searching = std::move(shorter);
        if (here.empty()) continue;
        std::vector<std::uint32_t> others;
        std::copy_if(places.begin(), places.end(), std::back_inserter(others),
                     [&](std::uint32_t p) { return reach[p] > 0.5 * cell; });
        const PlaceGrid grid(mesh, others, cell);
        for (const std::uint32_t p : here) {
            grid.near(mesh.positions[p], [&](std::uint32_t q) {
                if (glm::distance(mesh.positions[p], mesh.positions[q]) <=
                    std::min(reach[p], reach[q]))
                    merged += sets.unite(p, q) ? 1 : 0;
            });
        }
    }
    if (merged == 0) return 0;
    std::vector<std::uint32_t> number(mesh.positions.size());
    for (std::uint32_t p = 0; p < number.size(); ++p) number[p] = sets.find(p);
    renumber(mesh, number);
    return merged;
}

// The places that lie on an edge between its ends, from the first end to the second.
std::vector<std::uint32_t> places_along(const WeldedMesh& mesh, const PlaceGrid& grid,
                                        const glm::uvec2& edge, double step, double tolerance) {
    const DVec3& a = mesh.positions[edge.x];
    const DVec3& b = mesh.positions[edge.y];
    const double length = glm::distance(a, b);
    std::vector<std::pair<double, std::uint32_t>> found;
    const double steps = std::ceil(std::min(length / step, kMostCells));
    for (double s = 0.0; s <= steps; s += 1.0) {
        grid.near(glm::mix(a, b, s / steps), [&](std::uint32_t p) {
            if (p == edge.x || p == edge.y) return;
            const double along = glm::dot(mesh.positions[p] - a, b - a) / (length * length);
            const bool is_inside = along * length > tolerance && (1.0 - along) * length > tolerance;
            if (is_inside && glm::distance(glm::mix(a, b, along), mesh.positions[p]) <= tolerance)
                found.emplace_back(along, p);
        });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<std::uint32_t> places;
    for (const auto& [along, place] : found) places.push_back(place);
    return places;
}

// Once for each triangle at most, since its other sides are then another's.
std::size_t split_boundary(WeldedMesh& mesh, const std::vector<Side>& boundary, double tolerance) {
    std::vector<double> lengths;
    for (const Side& side : boundary) lengths.push_back(length_of(mesh, side.edge));
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    const double step = std::max(*middle, 4.0 * tolerance);
    const PlaceGrid grid(mesh, places_on(boundary), step);
    std::vector<bool> is_split(mesh.triangles.size(), false);
    std::size_t count = 0;
    for (const Side& side : boundary) {
        if (is_split[side.triangle]) continue;
        std::vector<std::uint32_t> between = places_along(mesh, grid, side.edge, step, tolerance);
        const Triangle whole = mesh.triangles[side.triangle];
        const std::uint32_t apex = whole[(side.corner + 2) % 3];
        std::erase(between, apex);
        if (between.empty()) continue;
        is_split[side.triangle] = true;
        count += between.size();
        if (!side.is_forward) std::reverse(between.begin(), between.end());
        std::uint32_t from = whole[side.corner];
        between.push_back(whole[(side.corner + 1) % 3]);
        mesh.triangles[side.triangle] = {from, between.front(), apex};
        for (std::size_t i = 1; i < between.size(); ++i) {
            mesh.triangles.emplace_back(between[i - 1], between[i], apex);
            mesh.input_triangle.push_back(mesh.input_triangle[side.triangle]);
        }
    }
    return count;
}

}  // namespace

void close_cracks(WeldedMesh& mesh, double tolerance, std::vector<Repair>& repairs) {
    if (!(tolerance > 0.0)) return;
    tolerance = std::min(tolerance, std::numeric_limits<double>::max());  // of a diagonal too long
    std::vector<Side> boundary = boundary_sides(mesh);
    if (boundary.empty()) return;
    const std::size_t merged = weld_boundary(mesh, boundary, tolerance);
    note(repairs, "vertices on boundary edges welded within the tolerance", merged);
    std::size_t split = 0;
    for (int round = 0; round < kMostRounds; ++round) {
        if (round > 0 || merged > 0) boundary = boundary_sides(mesh);
        if (boundary.empty()) break;
        const std::size_t more = split_boundary(mesh, boundary, tolerance);
        split += more;
        if (more == 0) break;
    }
    note(repairs, "T-junctions: boundary edges split at the vertices that lie on them", split);
}

}  // namespace zskel
