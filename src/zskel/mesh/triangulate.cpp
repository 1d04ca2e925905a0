// Ear clipping (G. H. Meisters, "Polygons have ears", 1975) in the plane of Newell's normal.
// Differs: corners on a straight line are cut last, so that they end in triangles with area where
// that is possible, and a corner at the place of an ear's own corner does not block it, so that
// outlines with a bridge to a hole are cut too.
#include "zskel/mesh/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

#include "zskel/core/assert.h"

namespace zskel {
namespace {

/// Sine of the angle up to which two edges count as one straight line: rounding, with room.
constexpr double kStraightSine = 1e-12;
/// Up to which difference a quad's two cuts count as equally good.
constexpr double kEvenCuts = 1e-9;

DVec3 newell_normal(std::span<const DVec3> positions, std::span<const std::uint32_t> polygon) {
    const DVec3 origin = positions[polygon[0]];
    DVec3 normal(0.0);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const DVec3 a = positions[polygon[i]] - origin;
        const DVec3 b = positions[polygon[(i + 1) % polygon.size()]] - origin;
        normal += glm::cross(a, b);
    }
    return normal;
}

/// Twice the area of a b c, positive when counter-clockwise.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 u = b - a;
    const glm::dvec2 v = c - a;
    return u.x * v.y - u.y * v.x;
}

enum class Turn { Left, Straight, Right };

Turn turn_at(const glm::dvec2& before, const glm::dvec2& here, const glm::dvec2& after) {
    const double area = area2(before, here, after);
    const double straight = kStraightSine * glm::length(here - before) * glm::length(after - here);
    if (std::abs(area) <= straight) return Turn::Straight;
    return area > 0.0 ? Turn::Left : Turn::Right;
}

/// The polygon seen against its normal: drops the largest axis, which rounds nothing.
std::vector<glm::dvec2> flatten(std::span<const DVec3> positions,
                                std::span<const std::uint32_t> polygon, const DVec3& normal) {
    const DVec3 size = glm::abs(normal);
    const int dropped = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const int first = (dropped + 1) % 3;
    const int second = (dropped + 2) % 3;
    const double sign = normal[dropped] < 0.0 ? -1.0 : 1.0;
    std::vector<glm::dvec2> flat;
    flat.reserve(polygon.size());
    const DVec3 origin = positions[polygon[0]];
    for (const std::uint32_t vertex : polygon) {
        const DVec3 p = positions[vertex] - origin;
        flat.emplace_back(p[first] * sign, p[second]);
    }
    return flat;
}

/// What is left of an outline while ears are cut from it: a ring of corners.
class Outline {
  public:
    Outline(std::vector<glm::dvec2> flat, std::span<const std::uint32_t> polygon,
            std::size_t& looks_left)
        : flat_(std::move(flat)),
          polygon_(polygon),
          looks_left_(looks_left),
          next_(polygon.size()),
          prev_(polygon.size()),
          by_x_(polygon.size()),
          is_cut_(polygon.size(), false),
          asked_(polygon.size(), 0) {
        const auto n = static_cast<std::uint32_t>(polygon.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            prev_[i] = (i + n - 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) ask(i);
        std::iota(by_x_.begin(), by_x_.end(), 0U);
        std::sort(by_x_.begin(), by_x_.end(),
                  [this](auto l, auto r) { return flat_[l].x < flat_[r].x; });
    }

    std::uint32_t next(std::uint32_t corner) const { return next_[corner]; }

    Turn turn(std::uint32_t corner) const {
        return turn_at(flat_[prev_[corner]], flat_[corner], flat_[next_[corner]]);
    }

    bool is_spent() const { return looks_left_ == 0; }

    bool is_ear(std::uint32_t corner) {
        if (is_spent()) return false;
        --looks_left_;
        if (turn(corner) != Turn::Left) return false;
        const auto [low, high] =
            std::minmax({flat_[prev_[corner]].x, flat_[corner].x, flat_[next_[corner]].x});
        auto at = std::lower_bound(by_x_.begin(), by_x_.end(), low,
                                   [this](auto i, double x) { return flat_[i].x < x; });
        for (; at != by_x_.end() && flat_[*at].x <= high && !is_spent(); ++at) {
            --looks_left_;
            if (!is_cut_[*at] && blocks(corner, *at)) return false;
        }
        return !is_spent();
    }

    /// The ear that was asked for longest ago; kNone when there is none among those.
    std::uint32_t take_ear() {
        while (!queue_.empty() && !is_spent()) {
            const auto [corner, turn] = queue_.front();
            queue_.pop();
            if (!is_cut_[corner] && asked_[corner] == turn && is_ear(corner)) return corner;
        }
        return kNone;
    }

    Triangle cut(std::uint32_t corner) {
        const std::uint32_t before = prev_[corner];
        const std::uint32_t after = next_[corner];
        next_[before] = after;
        prev_[after] = before;
        is_cut_[corner] = true;
        // Only here can new ears be. Last, which spreads ears over the outline and keeps them
        // small.
        ask(before);
        ask(after);
        // Ears get wider while corners get fewer.
        if (2 * ++cut_in_list_ > by_x_.size()) {
            std::erase_if(by_x_, [this](std::uint32_t i) { return is_cut_[i]; });
            cut_in_list_ = 0;
        }
        return {polygon_[before], polygon_[corner], polygon_[after]};
    }

  private:
    void ask(std::uint32_t corner) {
        asked_[corner] = ++asked_so_far_;
        queue_.emplace(corner, asked_so_far_);
    }

    /// True when corner i lies in or on the triangle at `ear`, but on none of its corners.
    bool blocks(std::uint32_t ear, std::uint32_t i) const {
        const glm::dvec2& a = flat_[prev_[ear]];
        const glm::dvec2& b = flat_[ear];
        const glm::dvec2& c = flat_[next_[ear]];
        const glm::dvec2& p = flat_[i];
        if (turn_at(a, b, p) == Turn::Right || turn_at(b, c, p) == Turn::Right ||
            turn_at(c, a, p) == Turn::Right) {
            return false;
        }
        return p != a && p != b && p != c && turn(i) != Turn::Left;
    }

    std::vector<glm::dvec2> flat_;
    std::span<const std::uint32_t> polygon_;
    std::size_t& looks_left_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> prev_;
    std::vector<std::uint32_t>
        by_x_;  // corners from left to right: ears are narrow, few lie below one
    std::vector<bool> is_cut_;
    std::size_t cut_in_list_ = 0;                              // of by_x_
    std::queue<std::pair<std::uint32_t, std::size_t>> queue_;  // corners to look at, and when asked
    std::vector<std::size_t> asked_;                           // of every corner: when last
    std::size_t asked_so_far_ = 0;
};

/// A corner that can be cut; kNone when there is none, or none was found in time.
std::uint32_t find_cut(Outline& outline, std::uint32_t start, std::size_t left) {
    const std::uint32_t ear = outline.take_ear();
    if (ear != kNone) return ear;
    std::uint32_t corner = start;
    for (std::size_t i = 0; i < left && !outline.is_spent(); ++i, corner = outline.next(corner)) {
        if (outline.turn(corner) == Turn::Straight || outline.is_ear(corner)) return corner;
    }
    return kNone;
}

bool clip_ears(Outline outline, std::size_t corners, std::vector<Triangle>& triangles) {
    std::uint32_t hub = 0;
    bool proper = true;
    for (std::size_t left = corners; left > 3; --left) {
        std::uint32_t corner = proper ? find_cut(outline, hub, left) : kNone;
        proper = corner != kNone;
        if (!proper) corner = outline.next(hub);
        if (proper) hub = outline.next(corner);
        triangles.push_back(outline.cut(corner));
    }
    triangles.push_back(outline.cut(outline.next(hub)));
    return proper;
}

/// Where the lowest vertex number is, whichever the outline begins with.
std::size_t lowest_corner(std::span<const std::uint32_t> polygon) {
    return static_cast<std::size_t>(std::ranges::min_element(polygon) - polygon.begin());
}

/// The better of a quad's two cuts: the one whose smaller triangle is larger; of two as good, the
/// one through the lowest vertex number.
bool split_quad(std::span<const DVec3> positions, std::span<const std::uint32_t> quad,
                const DVec3& normal, std::vector<Triangle>& triangles) {
    const auto area = [&](int a, int b, int c) {
        const DVec3& origin = positions[quad[a]];
        return glm::dot(normal,
                        glm::cross(positions[quad[b]] - origin, positions[quad[c]] - origin));
    };
    const double along_02 = std::min(area(0, 1, 2), area(0, 2, 3));
    const double along_13 = std::min(area(0, 1, 3), area(1, 2, 3));
    const double rounding = kEvenCuts * std::max(std::abs(along_02), std::abs(along_13));
    const bool is_even = std::abs(along_02 - along_13) <= rounding;
    if (is_even ? lowest_corner(quad) % 2 == 0 : along_02 > along_13) {
        triangles.emplace_back(quad[0], quad[1], quad[2]);
        triangles.emplace_back(quad[0], quad[2], quad[3]);
    } else {
        triangles.emplace_back(quad[0], quad[1], quad[3]);
        triangles.emplace_back(quad[1], quad[2], quad[3]);
    }
    return std::max(along_02, along_13) >= 0.0;
}

void fan(std::span<const std::uint32_t> polygon, std::vector<Triangle>& triangles) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        triangles.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
    }
}

}  // namespace

bool triangulate(std::span<const DVec3> positions, std::span<const std::uint32_t> polygon,
                 std::vector<Triangle>& triangles, std::size_t& looks_left) {
    ZSKEL_ASSERT(polygon.size() >= 3, "a polygon has three corners or more");
    if (polygon.size() == 3) {
        triangles.emplace_back(polygon[0], polygon[1], polygon[2]);
        return true;
    }
    // Scaled, so that what follows neither over- nor underflows before the input does.
    DVec3 normal = newell_normal(positions, polygon);
    const double size = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!(size > 0.0) || !std::isfinite(size)) {
        fan(polygon, triangles);
        return false;
    }
    normal /= size;
    if (polygon.size() == 4) return split_quad(positions, polygon, normal, triangles);
    // From the lowest vertex number on, towards the lower one beside it.
    const std::size_t count = polygon.size();
    const std::size_t first = lowest_corner(polygon);
    const bool is_backward = polygon[(first + count - 1) % count] < polygon[(first + 1) % count];
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < count; ++i)
        corners.push_back(polygon[(first + (is_backward ? count - i : i)) % count]);
    if (is_backward) normal = -normal;
    const std::size_t before = triangles.size();
    const bool is_proper = clip_ears(
        Outline(flatten(positions, corners, normal), corners, looks_left), count, triangles);
    for (std::size_t t = before; is_backward && t < triangles.size(); ++t)
        std::swap(triangles[t].y, triangles[t].z);
    return is_proper;
}

}  // namespace zskel
