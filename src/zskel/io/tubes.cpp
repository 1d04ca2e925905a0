// Circles of vertices around the nodes of a branch, in the planes that halve the angles, without
// twist from one to the next (each frame is the one before it, projected).
#include "zskel/io/tubes.h"

#include <cmath>
#include <numbers>
#include <span>

namespace zskel {
namespace {

/// Circles of a half ball between its pole and its rim, which is the tube's first or last circle.
constexpr int kCapCircles = 3;

struct Frame {
    DVec3 along{0.0};
    DVec3 across{0.0};
};

DVec3 any_across(const DVec3& along) {
    const DVec3 axis = std::abs(along.x) < 0.6 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    return glm::normalize(axis - along * glm::dot(axis, along));
}

/// The unit vector, or `otherwise` where there is no direction.
DVec3 unit_or(const DVec3& v, const DVec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
}

/// Directions at the points of a line: halfway between those of the pieces before and behind.
std::vector<Frame> frames_along(std::span<const DVec3> points, bool is_ring) {
    const std::size_t count = points.size();
    std::vector<DVec3> pieces;
    DVec3 last(0, 0, 1);
    for (std::size_t i = 0; i + (is_ring ? 0 : 1) < count; ++i) {
        last = unit_or(points[(i + 1) % count] - points[i], last);
        pieces.push_back(last);
    }
    if (!is_ring) pieces.push_back(last);
    std::vector<Frame> frames(count);
    for (std::size_t i = 0; i < count; ++i) {
        const DVec3& before = i > 0 ? pieces[i - 1] : pieces[is_ring ? count - 1 : 0];
        frames[i].along = unit_or(before + pieces[i], before);
        if (i == 0) {
            frames[i].across = any_across(frames[i].along);
            continue;
        }
        const DVec3& earlier = frames[i - 1].across;
        const DVec3& along = frames[i].along;
        frames[i].across = unit_or(earlier - along * glm::dot(earlier, along), any_across(along));
    }
    return frames;
}

class TubeBuilder {
  public:
    TubeBuilder(const SkeletonGraph& graph, std::uint32_t sides) : graph_(graph), sides_(sides) {}

    void add_open(const std::vector<std::uint32_t>& nodes) {
        const std::vector<Frame> frames = frames_along(places(nodes), false);
        std::uint32_t at = add_pole(nodes.front(), frames.front(), -1.0);
        const std::uint32_t first_pole = at;
        for (int i = kCapCircles; i > 0; --i) at = add_circle(nodes.front(), frames.front(), -i);
        for (std::size_t i = 0; i < nodes.size(); ++i) at = add_circle(nodes[i], frames[i], 0);
        for (int i = 1; i <= kCapCircles; ++i) at = add_circle(nodes.back(), frames.back(), i);
        const std::uint32_t last_pole = add_pole(nodes.back(), frames.back(), 1.0);
        for (std::uint32_t circle = first_pole + 1; circle < at; circle += sides_)
            join_circles(circle, circle + sides_, 0);
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const std::uint32_t next = (j + 1) % sides_;
            out_.triangles.emplace_back(first_pole, first_pole + 1 + next, first_pole + 1 + j);
            out_.triangles.emplace_back(last_pole, at + j, at + next);
        }
    }

    /// @param nodes  each once.
    void add_ring(const std::vector<std::uint32_t>& nodes) {
        const std::vector<Frame> frames = frames_along(places(nodes), true);
        const auto first = static_cast<std::uint32_t>(out_.positions.size());
        std::uint32_t at = first;
        for (std::size_t i = 0; i < nodes.size(); ++i) at = add_circle(nodes[i], frames[i], 0);
        for (std::uint32_t circle = first; circle < at; circle += sides_)
            join_circles(circle, circle + sides_, 0);
        join_circles(at, first, turn_between(frames.back(), frames.front()));
    }

    TubeSurface finish() { return std::move(out_); }

  private:
    std::vector<DVec3> places(const std::vector<std::uint32_t>& nodes) const {
        std::vector<DVec3> points;
        for (const std::uint32_t n : nodes) points.push_back(graph_.nodes[n].position);
        return points;
    }

    /// @param latitude  in steps from the rim of the half ball, 0, to its pole, kCapCircles + 1.
    std::uint32_t add_circle(std::uint32_t n, const Frame& frame, int latitude) {
        const SkeletonGraph::Node& node = graph_.nodes[n];
        const double angle = latitude * std::numbers::pi / (2.0 * (kCapCircles + 1));
        const DVec3 center = node.position + frame.along * (node.radius * std::sin(angle));
        const double radius = node.radius * std::cos(angle);
        const DVec3 third = glm::cross(frame.along, frame.across);
        const auto first = static_cast<std::uint32_t>(out_.positions.size());
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const double turn = 2.0 * std::numbers::pi * j / sides_;
            out_.positions.push_back(
                center + (frame.across * std::cos(turn) + third * std::sin(turn)) * radius);
            out_.node.push_back(n);
        }
        return first;
    }

    std::uint32_t add_pole(std::uint32_t n, const Frame& frame, double side) {
        const SkeletonGraph::Node& node = graph_.nodes[n];
        out_.positions.push_back(node.position + frame.along * (node.radius * side));
        out_.node.push_back(n);
        return static_cast<std::uint32_t>(out_.positions.size() - 1);
    }

    /// @param turn  steps by which the second circle begins later.
    void join_circles(std::uint32_t a, std::uint32_t b, std::uint32_t turn) {
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const std::uint32_t next = (j + 1) % sides_;
            const std::uint32_t b0 = b + (j + turn) % sides_;
            const std::uint32_t b1 = b + (next + turn) % sides_;
            out_.triangles.emplace_back(a + j, a + next, b1);
            out_.triangles.emplace_back(a + j, b1, b0);
        }
    }

    /// Steps of the circle `to` at which that of `from` begins, to the nearest.
    std::uint32_t turn_between(const Frame& from, const Frame& to) const {
        const DVec3 third = glm::cross(to.along, to.across);
        const double angle =
            std::atan2(glm::dot(from.across, third), glm::dot(from.across, to.across));
        const double steps = std::round(angle / (2.0 * std::numbers::pi) * sides_);
        return static_cast<std::uint32_t>(steps + sides_) % sides_;
    }

    const SkeletonGraph& graph_;
    std::uint32_t sides_;
    TubeSurface out_;
};

}  // namespace

TubeSurface tube_surface(const SkeletonGraph& graph, std::uint32_t sides) {
    TubeBuilder builder(graph, sides);
    for (Branch& branch : find_branches(graph)) {
        if (branch.is_ring) {
            branch.nodes.pop_back();
            builder.add_ring(branch.nodes);
        } else {
            builder.add_open(branch.nodes);
        }
    }
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    for (std::uint32_t n = 0; n < degrees.size(); ++n)
        if (degrees[n] == 0) builder.add_open({n});
    return builder.finish();
}

}  // namespace zskel
