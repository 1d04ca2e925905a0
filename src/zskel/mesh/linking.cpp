// Linking numbers by counting: two closed curves link as often as one passes over the other, signs
// taken, in any projection. The degenerate cases are those of Edelsbrunner and Muecke's Simulation
// of Simplicity (1990), with one step for everything on the upper curve.
#include "zskel/mesh/linking.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <utility>

#include "zskel/core/parallel.h"

namespace zskel {
namespace {

constexpr int kGridBits = 28;      // of a coordinate, without its sign
constexpr int kMostCellBits = 10;  // of the number of cells along a side

// A rotation without any pattern: quaternion (1, 2^(1/2), 3^(1/3), 5^(1/5)), normalised.
const glm::dmat3 kTurn =
    glm::mat3_cast(glm::normalize(glm::dquat(1.0, 1.41421356237, 1.44224957031, 1.37972966146)));

int sign_of(std::int64_t value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

}  // namespace

Passages::Passages(std::span<const Vec3> positions, std::span<const glm::uvec2> edges) {
    double size = 0.0;
    for (const Vec3& p : positions) size = std::max(size, glm::length(DVec3(p)));
    scale_ = 0.999 * std::ldexp(1.0, kGridBits) / std::max(size, 1e-9);
    int bits = 0;
    while (bits < kMostCellBits && (std::size_t{1} << (2 * bits)) < edges.size()) ++bits;
    cell_shift_ = kGridBits + 1 - bits;
    cells_ = std::int64_t{1} << bits;
    for (const glm::uvec2& e : edges)
        segments_.push_back({project(positions[e.x]), project(positions[e.y])});
    const auto each_cell = [&](const auto& visit) {
        for (std::uint32_t s = 0; s < segments_.size(); ++s) {
            const auto [x0, x1] = std::minmax(segments_[s].from.x, segments_[s].to.x);
            const auto [y0, y1] = std::minmax(segments_[s].from.y, segments_[s].to.y);
            for (std::int64_t y = cell(y0); y <= cell(y1); ++y) {
                for (std::int64_t x = cell(x0); x <= cell(x1); ++x)
                    visit(static_cast<std::size_t>(y * cells_ + x), s);
            }
        }
    };
    first_.assign(static_cast<std::size_t>(cells_ * cells_) + 1, 0);
    each_cell([&](std::size_t c, std::uint32_t) { ++first_[c + 1]; });
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    listed_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each_cell([&](std::size_t c, std::uint32_t s) { listed_[next[c]++] = s; });
}

Passages::Point Passages::project(const Vec3& position) const {
    const DVec3 turned = kTurn * DVec3(position);
    return {std::llround(turned.x * scale_), std::llround(turned.y * scale_), turned.z};
}

std::int64_t Passages::cell(std::int64_t coordinate) const {
    return std::clamp<std::int64_t>((coordinate + (std::int64_t{1} << kGridBits)) >> cell_shift_, 0,
                                    cells_ - 1);
}

// The sign of the crossing where the first segment runs over the second; 0 where it does not.
std::int32_t Passages::passage(const Segment& over, const Segment& under) {
    // Twice the area of (from, to, p); where it is 0 the sign after p has been moved by (e, e^2),
    // times `moved`.
    struct Side {
        std::int64_t area;
        int sign;
    };
    const auto side = [](const Segment& s, const Point& p, int moved) {
        const std::int64_t dx = s.to.x - s.from.x;
        const std::int64_t dy = s.to.y - s.from.y;
        const std::int64_t area = dx * (p.y - s.from.y) - dy * (p.x - s.from.x);
        if (area != 0) return Side{area, sign_of(area)};
        return Side{0, moved * (dy != 0 ? -sign_of(dy) : sign_of(dx))};
    };
    const Side a = side(under, over.from, 1);
    const Side b = side(under, over.to, 1);
    if (a.sign * b.sign >= 0) return 0;
    const Side c = side(over, under.from, -1);
    const Side d = side(over, under.to, -1);
    if (c.sign * d.sign >= 0) return 0;
    const auto height = [](const Segment& s, const Side& from, const Side& to) {
        const auto span = static_cast<double>(from.area - to.area);
        const double share = span != 0.0 ? static_cast<double>(from.area) / span : 0.5;
        return s.from.z + (s.to.z - s.from.z) * share;
    };
    if (height(over, a, b) <= height(under, c, d)) return 0;
    return a.sign;
}

void Passages::find(const Vec3& from, const Vec3& to, std::vector<Passage>& out) const {
    const Segment over{project(from), project(to)};
    const auto [x0, x1] = std::minmax(over.from.x, over.to.x);
    const auto [y0, y1] = std::minmax(over.from.y, over.to.y);
    for (std::int64_t y = cell(y0); y <= cell(y1); ++y) {
        for (std::int64_t x = cell(x0); x <= cell(x1); ++x) {
            const auto c = static_cast<std::size_t>(y * cells_ + x);
            for (std::uint32_t k = first_[c]; k < first_[c + 1]; ++k) {
                const Segment& under = segments_[listed_[k]];
                // Once for each pair: in the first cell that both boxes share.
                const std::int64_t low_x = std::max(x0, std::min(under.from.x, under.to.x));
                const std::int64_t low_y = std::max(y0, std::min(under.from.y, under.to.y));
                if (cell(low_x) != x || cell(low_y) != y) continue;
                const std::int32_t sign = passage(over, under);
                if (sign != 0) out.push_back({listed_[k], sign});
            }
        }
    }
}

LoopPassages::LoopPassages(const std::vector<std::vector<std::uint32_t>>& loops,
                           std::span<const Vec3> positions)
    : loop_count_(loops.size()) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;
    for (std::uint32_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = 0; i < loops[l].size(); ++i) {
            const std::uint32_t a = loops[l][i];
            const std::uint32_t b = loops[l][(i + 1) % loops[l].size()];
            const auto [at, is_new] = known.try_emplace(std::minmax(a, b), edges_.size());
            if (is_new) {
                edges_.emplace_back(std::min(a, b), std::max(a, b));
                uses_.emplace_back();
                weights_.push_back(0);
            }
            uses_[at->second].push_back({l, a < b ? 1 : -1});
            weights_[at->second] += a < b ? random_number(l) : -random_number(l);
        }
    }
    passages_ = Passages(positions, edges_);
}

std::vector<std::vector<std::int64_t>> LoopPassages::link(std::span<const Vec3> inner) const {
    std::vector<std::vector<Passages::Passage>> over(edges_.size());
    parallel_for(over.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e)
            passages_.find(inner[edges_[e].x], inner[edges_[e].y], over[e]);
    });
    std::vector<std::vector<std::int64_t>> matrix(loop_count_,
                                                  std::vector<std::int64_t>(loop_count_, 0));
    std::vector<std::int64_t> row(loop_count_, 0);
    std::vector<std::uint32_t> touched;
    for (std::size_t e = 0; e < over.size(); ++e) {
        for (const Passages::Passage& passage : over[e]) {
            for (const Use& use : uses_[passage.edge]) {
                touched.push_back(use.loop);
                row[use.loop] += passage.sign * use.sign;
            }
        }
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const Use& use : uses_[e]) {
            for (const std::uint32_t l : touched) matrix[use.loop][l] += use.sign * row[l];
        }
        for (const std::uint32_t l : touched) row[l] = 0;
        touched.clear();
    }
    return matrix;
}

std::uint64_t LoopPassages::hash(const Vec3& from, const Vec3& to) const {
    std::vector<Passages::Passage> over;
    passages_.find(from, to, over);
    std::uint64_t sum = 0;
    for (const Passages::Passage& passage : over)
        sum += passage.sign > 0 ? weights_[passage.edge] : -weights_[passage.edge];
    return sum;
}

std::uint64_t random_number(std::uint64_t k) {
    std::uint64_t z = (k + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

}  // namespace zskel
