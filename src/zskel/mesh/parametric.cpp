// Surfaces given by formulas, as triangles: the paper's method serves any shape that can be drawn.
#include "zskel/mesh/parametric.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/core/lattice_hash.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/mesh_builder.h"

namespace zskel {
namespace {

constexpr int kLeastSteps = 4;  // fewer would not tell a curve that swings both ways
constexpr int kMostSteps = 512;
constexpr double kSamePlace = 1e-9;     // diagonals
constexpr double kLeastWidth = 1e-9;    // of a triangle, in its length
constexpr double kFarthestCell = 1e15;  // of the places that are numbered; all beyond it share one
constexpr std::size_t kMostCells = 8'000'000;  // of the grids of a group, two triangles each

// De Casteljau's way along one line of points.
template <typename Point>
Point bezier_at(std::vector<Point> points, double t) {
    for (std::size_t left = points.size() - 1; left > 0; --left) {
        for (std::size_t i = 0; i < left; ++i)
            points[i] = points[i] * (1.0 - t) + points[i + 1] * t;
    }
    return points.front();
}

// De Boor's, within a span: knots[span] <= t <= knots[span + 1]. `point` gives a control point.
template <typename Point>
glm::dvec4 spline_at(Point point, const std::vector<double>& knots, std::size_t degree,
                     std::size_t span, double t) {
    std::vector<glm::dvec4> near(degree + 1);
    for (std::size_t i = 0; i <= degree; ++i) near[i] = point(span - degree + i);
    for (std::size_t round = 1; round <= degree; ++round) {
        for (std::size_t i = degree; i >= round; --i) {
            const double from = knots[span - degree + i];
            const double to = knots[span + 1 + i - round];
            const double share = to > from ? (t - from) / (to - from) : 0.0;
            near[i] = near[i - 1] * (1.0 - share) + near[i] * share;
        }
    }
    return near[degree];
}

std::vector<std::size_t> spans_of(const std::vector<double>& knots, int degree) {
    std::vector<std::size_t> out;
    const auto first = static_cast<std::size_t>(degree);
    for (std::size_t k = first; k + first + 1 < knots.size(); ++k) {
        if (knots[k + 1] > knots[k]) out.push_back(k);
    }
    return out;
}

// Where the ray at an angle meets |x|^(2 / e) + |y|^(2 / e) = 1.
glm::dvec2 superellipse(double angle, double exponent) {
    const glm::dvec2 ray(std::cos(angle), std::sin(angle));
    const double power = 2.0 / exponent;
    const double sum = std::pow(std::abs(ray.x), power) + std::pow(std::abs(ray.y), power);
    return ray * std::pow(sum, -1.0 / power);
}

double distance_to_line(const DVec3& p, const DVec3& a, const DVec3& b) {
    const DVec3 along = b - a;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? glm::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + along * share);
}

// The grid of a patch, and how far its triangles are from the patch between the grid's points.
class PatchGrid {
  public:
    PatchGrid(const ParametricPatch& patch, int steps) : patch_(patch), steps_(steps) {
        for (int row = 0; row <= steps; ++row) {
            for (int column = 0; column <= steps; ++column) places_.push_back(place(column, row));
        }
    }

    const std::vector<DVec3>& places() const { return places_; }

    // Along the patch's own edges from the curve, within it from the planes of the triangles.
    bool is_within(double bound) const {
        for (int i = 0; i < steps_; ++i) {
            for (const int side : {0, steps_}) {
                if (distance_to_line(place(i + 0.5, side), at(i, side), at(i + 1, side)) > bound ||
                    distance_to_line(place(side, i + 0.5), at(side, i), at(side, i + 1)) > bound)
                    return false;
            }
        }
        for (int row = 0; row < steps_; ++row) {
            for (int column = 0; column < steps_; ++column) {
                if (cell_error(column, row) > bound) return false;
            }
        }
        return true;
    }

    // Two a cell, of numbers of places.
    std::vector<Triangle> triangles() const {
        std::vector<Triangle> out;
        for (int row = 0; row < steps_; ++row) {
            for (int column = 0; column < steps_; ++column) {
                const auto [lower, upper] = cell(column, row);
                out.insert(out.end(), {lower, upper});
            }
        }
        return out;
    }

  private:
    double cell_error(int column, int row) const {
        const auto [lower, upper] = cell(column, row);
        const Triangle& left = is_rising(column, row) ? upper : lower;
        const DVec3 middle = place(column + 0.5, row + 0.5);
        return std::max(
            {distance_to_plane(place(column + 0.5, row), lower),
             distance_to_plane(place(column, row + 0.5), left),
             std::min(distance_to_plane(middle, lower), distance_to_plane(middle, upper))});
    }
    DVec3 place(double column, double row) const {
        return patch_.at(column / steps_, row / steps_);
    }
    std::uint32_t index(int column, int row) const {
        return static_cast<std::uint32_t>(row * (steps_ + 1) + column);
    }
    const DVec3& at(int column, int row) const { return places_[index(column, row)]; }
    bool is_rising(int column, int row) const {
        return glm::distance(at(column, row), at(column + 1, row + 1)) <=
               glm::distance(at(column + 1, row), at(column, row + 1));
    }
    // Cut along its shorter diagonal; the first holds the edge to the next column.
    std::pair<Triangle, Triangle> cell(int column, int row) const {
        const std::uint32_t a = index(column, row);
        const std::uint32_t b = index(column + 1, row);
        const std::uint32_t c = index(column + 1, row + 1);
        const std::uint32_t d = index(column, row + 1);
        if (is_rising(column, row)) return {{a, b, c}, {a, c, d}};
        return {{a, b, d}, {b, c, d}};
    }
    // Of a triangle that is no more than a line, from that.
    double distance_to_plane(const DVec3& p, const Triangle& t) const {
        const DVec3& a = places_[t.x];
        const DVec3 ab = places_[t.y] - a;
        const DVec3 ac = places_[t.z] - a;
        const DVec3 normal = glm::cross(ab, ac);
        const double size = glm::length(normal);
        const double longest = std::max(glm::length(ab), glm::length(ac));
        if (size > kLeastWidth * longest * longest) return std::abs(glm::dot(normal, p - a)) / size;
        return distance_to_line(p, a, glm::length(ab) < longest ? places_[t.z] : places_[t.y]);
    }

    const ParametricPatch& patch_;
    int steps_;
    std::vector<DVec3> places_;
};

std::vector<PatchGrid> grids_of(const PatchGroup& group, int steps) {
    std::vector<PatchGrid> grids;
    grids.reserve(group.size());
    for (const ParametricPatch& patch : group) grids.emplace_back(patch, steps);
    return grids;
}

// Numbers places, those within a distance of each other alike.
class Snapper {
  public:
    Snapper(const DVec3& origin, double within) : origin_(origin), within_(within) {}

    std::uint32_t add(const DVec3& place) {
        const DVec3 widths = (place - origin_) / (2.0 * within_);
        const glm::i64vec3 cell(glm::floor(glm::clamp(widths, -kFarthestCell, kFarthestCell)));
        for (std::int64_t i = 0; i < 27; ++i) {
            const glm::i64vec3 beside = cell + glm::i64vec3(i % 3, i / 3 % 3, i / 9) - 1L;
            const auto [first, last] = of_cell_.equal_range(beside);
            for (auto it = first; it != last; ++it) {
                if (glm::distance(places_[it->second], place) <= within_) return it->second;
            }
        }
        const auto number = static_cast<std::uint32_t>(places_.size());
        of_cell_.emplace(cell, number);
        places_.push_back(place);
        return number;
    }
    std::vector<DVec3> take_places() { return std::move(places_); }

  private:
    DVec3 origin_;
    double within_;
    std::vector<DVec3> places_;
    std::unordered_multimap<glm::i64vec3, std::uint32_t, LatticeHash> of_cell_;
};

void check_finite(const std::vector<PatchGrid>& grids, const std::string& name) {
    for (const PatchGrid& grid : grids) {
        for (const DVec3& p : grid.places()) {
            if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
            throw InputError(fmt::format("{}: a patch goes through ({}, {}, {}): not finite", name,
                                         p.x, p.y, p.z));
        }
    }
}

// The coarsest grids that keep within the bound. What did not is tried first with the next steps,
// alone: one patch that never will costs no more than itself.
std::vector<PatchGrid> fitting_grids(const PatchGroup& group, double bound,
                                     const std::string& name) {
    std::size_t hardest = 0;
    int steps = kLeastSteps;
    for (; steps <= kMostSteps; steps += std::max(1, steps / 8)) {
        const auto cells = static_cast<std::size_t>(steps) * static_cast<std::size_t>(steps);
        if (steps > kLeastSteps && cells * group.size() > kMostCells) break;
        if (!group.empty() && !PatchGrid(group[hardest], steps).is_within(bound)) continue;
        std::vector<PatchGrid> grids = grids_of(group, steps);
        check_finite(grids, name);
        const auto wide = std::find_if_not(grids.begin(), grids.end(),
                                           [&](const PatchGrid& g) { return g.is_within(bound); });
        if (wide == grids.end()) return grids;
        hardest = static_cast<std::size_t>(wide - grids.begin());
    }
    throw InputError(fmt::format(
        "{}: a patch needs {} steps or more to come within the chord error asked for; a larger "
        "--chord-error is needed",
        name, steps));
}

}  // namespace

ParametricPatch bezier_patch(std::vector<std::vector<DVec3>> points) {
    return {[points = std::move(points)](double u, double v) {
        std::vector<DVec3> column;
        for (const std::vector<DVec3>& row : points) column.push_back(bezier_at(row, u));
        return bezier_at(std::move(column), v);
    }};
}

PatchGroup nurbs_patches(const Nurbs& nurbs) {
    // Weighted once, and kept once for all spans: sums of them are what is divided by the sums of
    // weights.
    Nurbs weighted = nurbs;
    for (auto& row : weighted.points) {
        for (glm::dvec4& p : row) p = glm::dvec4(DVec3(p) * p.w, p.w);
    }
    const auto shared = std::make_shared<const Nurbs>(std::move(weighted));
    PatchGroup out;
    for (const std::size_t span_v : spans_of(nurbs.knots_v, nurbs.degree_v)) {
        for (const std::size_t span_u : spans_of(nurbs.knots_u, nurbs.degree_u)) {
            out.push_back({[shared, span_u, span_v](double u, double v) {
                const auto& [degree_u, degree_v, knots_u, knots_v, points] = *shared;
                const double at_u = glm::mix(knots_u[span_u], knots_u[span_u + 1], u);
                const double at_v = glm::mix(knots_v[span_v], knots_v[span_v + 1], v);
                const auto along_row = [&, &rows = points, &knots = knots_u,
                                        degree =
                                            static_cast<std::size_t>(degree_u)](std::size_t row) {
                    return spline_at([&](std::size_t column) { return rows[row][column]; }, knots,
                                     degree, span_u, at_u);
                };
                const glm::dvec4 sum =
                    spline_at(along_row, knots_v, static_cast<std::size_t>(degree_v), span_v, at_v);
                return DVec3(sum) / sum.w;
            }});
        }
    }
    return out;
}

PatchGroup superquadric_patches(const Superquadric& superquadric) {
    constexpr double kQuarter = std::numbers::pi / 2.0;
    PatchGroup out;
    for (const int south : {1, 0}) {
        for (int east = 0; east < 4; ++east) {
            out.push_back({[=](double u, double v) {
                const glm::dvec2 round =
                    superellipse(kQuarter * (east + u), superquadric.exponent_2);
                const glm::dvec2 up = superellipse(kQuarter * (v - south), superquadric.exponent_1);
                const DVec3 place(up.x * round.x, up.x * round.y, up.y);
                return superquadric.center +
                       glm::angleAxis(superquadric.turn, glm::normalize(superquadric.axis)) *
                           (superquadric.radii * place);
            }});
        }
    }
    return out;
}

Mesh tessellate(const std::vector<PatchGroup>& groups, double chord_error, const std::string& name,
                std::size_t max_faces) {
    Box box;
    for (const PatchGroup& group : groups) {
        const std::vector<PatchGrid> coarse = grids_of(group, kLeastSteps);
        check_finite(coarse, name);
        for (const PatchGrid& grid : coarse) {
            for (const DVec3& p : grid.places()) box.add(p);
        }
    }
    if (box.low.x <= box.high.x && !std::isfinite(box.diagonal()))
        throw InputError(fmt::format("{}: the patches reach too far to be measured", name));
    Snapper snapper(box.low,
                    std::max(kSamePlace * box.diagonal(), std::numeric_limits<double>::min()));
    MeshBuilder builder(name, max_faces);
    for (const PatchGroup& group : groups) {
        for (const PatchGrid& grid : fitting_grids(group, chord_error * box.diagonal(), name)) {
            std::vector<std::uint32_t> vertices;
            for (const DVec3& p : grid.places()) vertices.push_back(snapper.add(p));
            for (const Triangle& t : grid.triangles()) {
                const std::array<std::uint32_t, 3> corners{vertices[t.x], vertices[t.y],
                                                           vertices[t.z]};
                if (corners[0] != corners[1] && corners[1] != corners[2] &&
                    corners[2] != corners[0])
                    builder.add_face(corners);
            }
        }
    }
    builder.positions = snapper.take_places();
    return builder.finish();
}

}  // namespace zskel
