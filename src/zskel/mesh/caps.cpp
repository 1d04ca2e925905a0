#include "zskel/mesh/caps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/mesh/orient.h"
#include "zskel/mesh/sides.h"

namespace zskel {
namespace {

constexpr std::size_t kMostAtOnce = 160;  // places on a rim: the search takes their cube
constexpr double kThinnest = 0.05;        // thrice volume over area, in the caps' size
constexpr double kScrap = 1e-3;           // share of the area
constexpr double kMostInPlane = 0.7;      // cosine between the rim's walls and the cap
constexpr double kNever = std::numeric_limits<double>::infinity();

using Loop = std::vector<std::uint32_t>;  // places, in the direction that a cap runs along its rim

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

DVec3 area_vector(const WeldedMesh& mesh, const Triangle& t) {
    const DVec3& a = mesh.positions[t.x];
    return 0.5 * glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
}

double area_of(const WeldedMesh& mesh, const Triangle& t) {
    return glm::length(area_vector(mesh, t));
}

// Rims as they are walked round, fan by fan where a place has several, each place once.
class RimWalker {
  public:
    RimWalker(const WeldedMesh& mesh, const std::vector<Side>& sides)
        : mesh_(mesh), fans_(mesh.triangles.size() * 3) {
        for_each_edge(sides, [&](std::size_t first, std::size_t last) {
            if (last - first == 1) {
                open_.push_back(sides[first]);
            } else {
                for (std::size_t i = first + 1; i < last; ++i) {
                    fans_.unite(sides[i].low_corner(), sides[first].low_corner());
                    fans_.unite(sides[i].high_corner(), sides[first].high_corner());
                }
            }
        });
        // A triangle's side is run along the other way by its cap: from the corner it ends at.
        for (std::size_t i = 0; i < open_.size(); ++i) from_[fans_.find(end_corner(open_[i]))] = i;
    }

    std::vector<std::pair<Loop, std::uint32_t>> rims() {  // with a triangle beside each
        std::vector<std::pair<Loop, std::uint32_t>> out;
        std::vector<bool> is_walked(open_.size(), false);
        for (std::size_t start = 0; start < open_.size(); ++start) {
            Loop loop;
            std::size_t i = start;
            while (!is_walked[i]) {
                is_walked[i] = true;
                loop.push_back(place_at(end_corner(open_[i])));
                const auto next = from_.find(fans_.find(start_corner(open_[i])));
                if (next == from_.end()) break;
                i = next->second;
            }
            for (Loop& part : parted(loop))
                out.emplace_back(std::move(part), open_[start].triangle);
        }
        return out;
    }

  private:
    static std::uint32_t start_corner(const Side& side) {
        return side.is_forward ? side.low_corner() : side.high_corner();
    }
    static std::uint32_t end_corner(const Side& side) {
        return side.is_forward ? side.high_corner() : side.low_corner();
    }
    std::uint32_t place_at(std::uint32_t corner) const {
        return mesh_.triangles[corner / 3][static_cast<int>(corner % 3)];
    }

    // A loop that comes by a place twice is two.
    static std::vector<Loop> parted(const Loop& loop) {
        std::vector<Loop> out;
        Loop way;
        std::map<std::uint32_t, std::size_t> seen;
        for (const std::uint32_t place : loop) {
            const auto known = seen.find(place);
            if (known != seen.end()) {
                const std::size_t first = known->second;
                out.emplace_back(way.begin() + static_cast<std::ptrdiff_t>(first), way.end());
                for (std::size_t i = first; i < way.size(); ++i) seen.erase(way[i]);
                way.resize(first);
            }
            seen[place] = way.size();
            way.push_back(place);
        }
        out.push_back(way);
        std::erase_if(out, [](const Loop& part) { return part.size() < 3; });
        return out;
    }

    const WeldedMesh& mesh_;
    DisjointSets fans_;
    std::vector<Side> open_;
    std::map<std::uint32_t, std::size_t> from_;  // by fan: the side that starts there
};

// Triangles between the places of one rim.
class RimFiller {
  public:
    RimFiller(const WeldedMesh& mesh, const std::unordered_set<std::uint64_t>& edges)
        : mesh_(mesh), edges_(edges) {}

    // Nothing when each way would use an edge twice over.
    std::vector<Triangle> fill(const Loop& rim) const {
        std::vector<Triangle> out;
        std::vector<Loop> parts{rim};
        while (!parts.empty()) {
            const Loop part = std::move(parts.back());
            parts.pop_back();
            if (part.size() > kMostAtOnce) {
                const auto [a, b] = shortest_chord(part);
                if (a == b) return {};
                parts.emplace_back(part.begin() + a, part.begin() + b + 1);
                Loop rest(part.begin() + b, part.end());
                rest.insert(rest.end(), part.begin(), part.begin() + a + 1);
                parts.push_back(std::move(rest));
            } else if (!fill_least(part, out)) {
                return {};
            }
        }
        return out;
    }

  private:
    bool is_free(std::uint32_t a, std::uint32_t b) const { return !edges_.contains(key_of(a, b)); }

    // Between places about half the rim apart; equal numbers when there is none.
    std::pair<std::ptrdiff_t, std::ptrdiff_t> shortest_chord(const Loop& rim) const {
        const std::size_t n = rim.size();
        const std::size_t stride = std::max<std::size_t>(1, n / 512);
        std::pair<std::ptrdiff_t, std::ptrdiff_t> best{0, 0};
        double least = kNever;
        for (std::size_t a = 0; a < n; a += stride) {
            for (std::size_t b = a + n / 3; b < std::min(n, a + n - n / 3); b += stride) {
                const double length =
                    glm::distance(mesh_.positions[rim[a]], mesh_.positions[rim[b]]);
                if (length >= least || !is_free(rim[a], rim[b])) continue;
                least = length;
                best = {static_cast<std::ptrdiff_t>(a), static_cast<std::ptrdiff_t>(b)};
            }
        }
        return best;
    }

    bool fill_least(const Loop& rim, std::vector<Triangle>& out) const {
        const std::size_t n = rim.size();
        std::vector<double> least(n * n, kNever);  // area from place i round to place k
        std::vector<std::uint32_t> apex(n * n, 0);
        for (std::size_t i = 0; i + 1 < n; ++i) least[i * n + i + 1] = 0.0;
        for (std::size_t span = 2; span < n; ++span) {
            for (std::size_t i = 0; i + span < n; ++i) {
                const std::size_t k = i + span;
                if (span < n - 1 && !is_free(rim[i], rim[k])) continue;
                for (std::size_t m = i + 1; m < k; ++m) {
                    const double before = least[i * n + m] + least[m * n + k];
                    if (before >= least[i * n + k]) continue;
                    const double area = before + area_of(mesh_, {rim[i], rim[m], rim[k]});
                    if (area >= least[i * n + k]) continue;
                    least[i * n + k] = area;
                    apex[i * n + k] = static_cast<std::uint32_t>(m);
                }
            }
        }
        if (least[n - 1] == kNever) return false;
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
        while (!open.empty()) {
            const auto [i, k] = open.back();
            open.pop_back();
            if (k - i < 2) continue;
            const std::size_t m = apex[i * n + k];
            out.emplace_back(rim[i], rim[m], rim[k]);
            open.emplace_back(i, m);
            open.emplace_back(m, k);
        }
        return true;
    }

    const WeldedMesh& mesh_;
    const std::unordered_set<std::uint64_t>& edges_;
};

// The triangle at each edge that has one only.
using Walls = std::unordered_map<std::uint64_t, std::uint32_t>;

Opening opening_of(const WeldedMesh& mesh, const Loop& rim, const std::vector<Triangle>& cap,
                   const Walls& walls) {
    Opening out;
    double area = 0.0;
    DVec3 facing(0.0);
    for (const Triangle& t : cap) {
        area += area_of(mesh, t);
        facing += area_vector(mesh, t);
    }
    out.radius = std::sqrt(area / std::numbers::pi);
    double length = 0.0;
    double in_plane = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const std::uint32_t from = rim[i];
        const std::uint32_t to = rim[(i + 1) % rim.size()];
        const double step = glm::distance(mesh.positions[from], mesh.positions[to]);
        out.center += 0.5 * (mesh.positions[from] + mesh.positions[to]) * step;
        length += step;
        const auto wall = walls.find(key_of(from, to));
        if (wall == walls.end()) continue;
        const DVec3 normal = area_vector(mesh, mesh.triangles[wall->second]);
        const double norm = glm::length(normal) * glm::length(facing);
        if (norm > 0.0) in_plane += step * std::abs(glm::dot(normal, facing)) / norm;
    }
    out.center /= length;
    out.is_end = in_plane < kMostInPlane * length;
    return out;
}

// What a component becomes when its caps are on.
struct Capped {
    std::vector<Triangle> caps;
    std::vector<Opening> openings;
    double area = 0.0;  // of all
    double cap_area = 0.0;
    double volume = 0.0;
    bool has_rim = false;
    bool can_be = true;

    bool is_sheet() const { return 3.0 * volume < kThinnest * std::sqrt(cap_area) * area; }
};

void add_triangle(const WeldedMesh& mesh, const Triangle& t, const DVec3& from, Capped& capped) {
    capped.area += area_of(mesh, t);
    capped.volume += glm::dot(mesh.positions[t.x] - from,
                              glm::cross(mesh.positions[t.y] - from, mesh.positions[t.z] - from)) /
                     6.0;
}

// Caps on every rim of the components that may have them.
std::map<std::uint32_t, Capped> fill_rims(const WeldedMesh& mesh, const Orientation& parts) {
    const std::vector<Side> sides = sorted_sides(mesh.triangles, mesh.positions.size());
    std::unordered_set<std::uint64_t> edges;
    Walls walls;
    std::map<std::uint32_t, Capped> capped;
    for_each_edge(sides, [&](std::size_t first, std::size_t last) {
        const std::uint64_t key = key_of(sides[first].edge.x, sides[first].edge.y);
        edges.insert(key);
        if (last - first == 1) walls.emplace(key, sides[first].triangle);
        if (last - first > 2) capped[parts.component[sides[first].triangle]].can_be = false;
    });
    for (const auto& [rim, triangle] : RimWalker(mesh, sides).rims()) {
        const std::uint32_t component = parts.component[triangle];
        Capped& mine = capped[component];
        mine.has_rim = true;
        mine.can_be = mine.can_be && parts.component_orientable[component];
        if (!mine.can_be) continue;
        const std::vector<Triangle> cap = RimFiller(mesh, edges).fill(rim);
        mine.can_be = !cap.empty();
        if (cap.empty()) continue;
        for (const Triangle& t : cap) {
            for (int k = 0; k < 3; ++k) edges.insert(key_of(t[k], t[(k + 1) % 3]));
        }
        mine.openings.push_back(opening_of(mesh, rim, cap, walls));
        mine.openings.back().component = component;
        mine.caps.insert(mine.caps.end(), cap.begin(), cap.end());
    }
    return capped;
}

// Leaves out the components that stay open and are next to nothing beside all; the others get new
// numbers.
std::size_t drop_scraps(WeldedMesh& mesh, Orientation& parts, std::vector<Opening>& openings) {
    std::vector<double> areas(parts.component_count, 0.0);
    double all = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double area = area_of(mesh, mesh.triangles[t]);
        areas[parts.component[t]] += area;
        all += area;
    }
    const auto& closed = parts.component_closed;
    if (std::find(closed.begin(), closed.end(), true) == closed.end()) return 0;
    std::vector<std::uint32_t> number(parts.component_count, kNone);
    Orientation kept;
    for (std::uint32_t c = 0; c < number.size(); ++c) {
        if (!closed[c] && areas[c] < kScrap * all) continue;
        number[c] = kept.component_count++;
        kept.component_closed.push_back(closed[c]);
        kept.component_sheet.push_back(parts.component_sheet[c]);
        kept.component_orientable.push_back(parts.component_orientable[c]);
    }
    const std::size_t dropped = number.size() - kept.component_count;
    if (dropped == 0) return 0;
    std::vector<bool> drop(mesh.triangles.size());
    for (std::size_t t = 0; t < drop.size(); ++t) {
        const std::uint32_t c = number[parts.component[t]];
        drop[t] = c == kNone;
        if (c != kNone) kept.component.push_back(c);
    }
    drop_triangles(mesh, drop);
    keep_used_places(mesh);
    for (Opening& opening : openings) opening.component = number[opening.component];
    parts.component = std::move(kept.component);
    parts.component_count = kept.component_count;
    parts.component_closed = std::move(kept.component_closed);
    parts.component_sheet = std::move(kept.component_sheet);
    parts.component_orientable = std::move(kept.component_orientable);
    return dropped;
}

}  // namespace

std::vector<Opening> cap_openings(WeldedMesh& mesh, Orientation& parts,
                                  std::vector<Repair>& repairs) {
    if (parts.open_edges == 0) return {};
    std::map<std::uint32_t, Capped> capped = fill_rims(mesh, parts);
    for (auto& [component, mine] : capped) {
        if (mine.caps.empty()) continue;
        const DVec3 from = mesh.positions[mine.caps.front().x];
        for (const Triangle& t : mine.caps) add_triangle(mesh, t, from, mine);
        mine.cap_area = mine.area;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto mine = capped.find(parts.component[t]);
        if (mine == capped.end() || mine->second.caps.empty()) continue;
        add_triangle(mesh, mesh.triangles[t], mesh.positions[mine->second.caps.front().x],
                     mine->second);
    }
    std::vector<Opening> openings;
    std::size_t sheets = 0;
    std::size_t left = 0;
    std::vector<bool> is_turned(parts.component_count, false);
    for (auto& [component, mine] : capped) {
        if (!mine.can_be || mine.caps.empty()) {
            left += mine.has_rim ? 1 : 0;
            continue;
        }
        is_turned[component] = mine.volume < 0.0;
        mine.volume = std::abs(mine.volume);
        if (mine.is_sheet()) {
            parts.component_sheet[component] = true;
            ++sheets;
            continue;
        }
        parts.component_closed[component] = true;
        openings.insert(openings.end(), mine.openings.begin(), mine.openings.end());
        for (const Triangle& t : mine.caps) {
            mesh.triangles.push_back(t);
            mesh.input_triangle.push_back(kNone);
            parts.component.push_back(component);
        }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (is_turned[parts.component[t]]) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
    }
    const std::size_t scraps = drop_scraps(mesh, parts, openings);
    note(repairs, "loose scraps left out, of less than a thousandth of the area", scraps);
    note(repairs, "openings closed with caps, which are in no output", openings.size());
    note(repairs, "sheets left open: too thin to hold anything, their skeletons mean little",
         sheets);
    note(repairs,
         "parts left open, since caps do not fit: their skeletons may leave them, and may be wrong",
         left);
    return openings;
}

}  // namespace zskel
