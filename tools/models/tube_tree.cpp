// A joint's patch is the convex hull of points on one sphere, which is their Delaunay triangulation
// there (Brown 1979). Each rim gets a pole in its middle; the hull's triangles at the poles are the
// holes that the tubes continue. Rims lie far enough apart for their edges to be in the hull.
#include "tube_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace zskel::models {
namespace {

constexpr double kRimGap = 1.3;  // angle between two rims' axes over the sum of their half-angles
constexpr double kRingSpacing = 2.6;  // along a tube, in radii

double half_angle(double radius, double sphere) {
    return std::asin(std::min(1.0, radius / sphere));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

unsigned ring_points(double radius) {
    return radius > 0.010 ? 12 : 8;
}

/// Polygons of that many points and of the circle's area are this much wider than it.
double polygon_factor(unsigned points) {
    const double angle = 2.0 * std::numbers::pi / points;
    return std::sqrt(angle / std::sin(angle));
}

/// Outer radius of the ring of a tube.
double ring_radius(const Tube& tube) {
    return tube.radius * polygon_factor(ring_points(tube.radius));
}

glm::dvec3 direction_at(const Tube& tube, double t) {
    return glm::normalize(tube.at(t + 1e-4) - tube.at(t - 1e-4));
}

glm::dvec3 any_normal(const glm::dvec3& v) {
    return glm::normalize(
        glm::cross(v, std::abs(v.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
}

struct Ring {
    std::vector<unsigned> vertices;
    glm::dvec3 axis;
};

using Hull = std::vector<std::array<std::size_t, 3>>;

/// Convex hull of points on a sphere around the origin, by trying every triangle; faces turn
/// outward.
Hull hull_on_sphere(const std::vector<glm::dvec3>& points) {
    Hull hull;
    const std::size_t count = points.size();
    const auto is_on_hull = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec3 normal = glm::cross(points[b] - points[a], points[c] - points[a]);
        for (std::size_t p = 0; p < count; ++p) {
            if (p != a && p != b && p != c && glm::dot(points[p] - points[a], normal) > 0.0) {
                return false;
            }
        }
        return true;
    };
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            for (std::size_t c = a + 1; c < count; ++c) {
                if (c != b && is_on_hull(a, b, c)) {
                    hull.push_back({a, b, c});
                }
            }
        }
    }
    return hull;
}

class Sweep {
  public:
    Sweep(const std::string& name, const std::vector<Tube>& tubes, std::size_t open_ends)
        : tubes_(tubes), is_open_(tubes.size(), false), joints_(tubes.size()) {
        model_.name = name;
        choose_open_ends(open_ends);
    }

    Model run() {
        for (std::size_t i = 0; i < tubes_.size(); ++i) {
            sweep_tube(i);
        }
        for (std::size_t i = 0; i < tubes_.size(); ++i) {
            if (!tubes_[i].children.empty()) {
                close_joint(i);
            }
        }
        model_.expected.faces = model_.mesh.faces.size();
        return std::move(model_);
    }

  private:
    /// The rims at both ends of a tube, and the node of the truth at its end.
    struct Joint {
        Ring first, last;
        std::size_t node = 0;
    };

    void choose_open_ends(std::size_t count) {
        std::vector<std::size_t> ends;
        for (std::size_t i = 0; i < tubes_.size(); ++i) {
            if (tubes_[i].children.empty()) {
                ends.push_back(i);
            }
        }
        std::stable_sort(ends.begin(), ends.end(), [&](std::size_t a, std::size_t b) {
            return tubes_[a].radius > tubes_[b].radius;
        });
        is_root_open_ = count > 0;
        for (std::size_t i = 0; i + 1 < count; ++i) {
            is_open_[ends[i]] = true;
        }
        model_.expected.boundary_loops = count;
        model_.expected.ends = ends.size() + 1;
    }

    std::size_t add_node(const glm::dvec3& position, double radius, TruthLimb& limb) {
        const std::size_t node = model_.truth.nodes.size();
        model_.truth.nodes.push_back({position, radius});
        if (!limb.nodes.empty()) {
            model_.truth.edges.emplace_back(limb.nodes.back(), node);
        }
        limb.nodes.push_back(node);
        return node;
    }

    /// A ring around `centre`; `across` is where its first point lies, and is turned along.
    Ring add_ring(const glm::dvec3& centre, const glm::dvec3& axis, double radius, unsigned points,
                  glm::dvec3& across) {
        across = glm::normalize(across - glm::dot(across, axis) * axis);
        const glm::dvec3 up = glm::cross(axis, across);
        Ring ring{{}, axis};
        for (unsigned i = 0; i < points; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / points;
            ring.vertices.push_back(static_cast<unsigned>(model_.mesh.vertices.size()));
            model_.mesh.vertices.push_back(
                centre + radius * (std::cos(angle) * across + std::sin(angle) * up));
        }
        return ring;
    }

    void join_rings(const Ring& from, const Ring& to) {
        const std::size_t count = from.vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t j = (i + 1) % count;
            model_.mesh.faces.emplace_back(from.vertices[i], from.vertices[j], to.vertices[j]);
            model_.mesh.faces.emplace_back(from.vertices[i], to.vertices[j], to.vertices[i]);
        }
    }

    /// Goes on from `rim` along its axis: flat one radius further, or by a half sphere.
    void end_tube(const Ring& rim, const glm::dvec3& centre, double radius, bool is_open,
                  glm::dvec3 across) {
        const auto points = static_cast<unsigned>(rim.vertices.size());
        const double part = is_open ? 1.0 : std::sqrt(0.5);
        const Ring next =
            add_ring(centre + part * radius * rim.axis, rim.axis, part * radius, points, across);
        join_rings(rim, next);
        if (is_open) {
            return;
        }
        const auto pole = static_cast<unsigned>(model_.mesh.vertices.size());
        model_.mesh.vertices.push_back(centre + radius * rim.axis);
        for (unsigned i = 0; i < points; ++i) {
            model_.mesh.faces.emplace_back(next.vertices[i], next.vertices[(i + 1) % points], pole);
        }
    }

    /// How far the tube's rim is from the joint at the end of `joint`, along the tube.
    double rim_offset(const Tube& joint, const Tube& tube) const {
        const double sphere = joint_radius(tubes_, joint), radius = ring_radius(tube);
        return std::sqrt(sphere * sphere - radius * radius);
    }

    void sweep_tube(std::size_t index) {
        const Tube& tube = tubes_[index];
        const bool is_root = tube.parent == Tube::kNoParent, is_end = tube.children.empty();
        const double length = glm::distance(tube.start, tube.end);
        const double from = is_root ? 0.0 : rim_offset(tubes_[tube.parent], tube) / length;
        const double to = is_end ? 1.0 : 1.0 - rim_offset(tube, tube) / length;
        const double spans =
            std::max(2.0, std::round((to - from) * length / (kRingSpacing * tube.radius)));
        TruthLimb limb{fmt::format("branch {}", index), {}};
        if (!is_root) {
            limb.nodes.push_back(joints_[tube.parent].node);
        }
        glm::dvec3 across = any_normal(tube.start_direction);
        Ring ring = add_rim(tube.start, tube.start_direction, from * length, tube, across);
        joints_[index].first = ring;
        if (is_root) {
            Ring back{{ring.vertices.rbegin(), ring.vertices.rend()}, -ring.axis};
            std::rotate(back.vertices.begin(), back.vertices.end() - 1, back.vertices.end());
            end_tube(back, tube.start, ring_radius(tube), is_root_open_, across);
        }
        add_node(tube.start + from * length * tube.start_direction, tube.radius, limb);
        for (double k = 1.0; k < spans; k += 1.0) {
            const double t = from + (to - from) * k / spans;
            const Ring next = add_rim(tube.at(t), direction_at(tube, t), 0.0, tube, across);
            join_rings(ring, next);
            add_node(tube.at(t), tube.radius, limb);
            ring = next;
        }
        const Ring last = add_rim(tube.end, tube.end_direction, (to - 1.0) * length, tube, across);
        join_rings(ring, last);
        joints_[index].last = last;
        joints_[index].node = add_node(tube.end, tube.radius, limb);
        if (is_end) {
            end_tube(last, tube.end, ring_radius(tube), is_open_[index], across);
        }
        model_.truth.limbs.push_back(std::move(limb));
    }

    Ring add_rim(const glm::dvec3& origin, const glm::dvec3& direction, double offset,
                 const Tube& tube, glm::dvec3& across) {
        return add_ring(origin + offset * direction, direction, ring_radius(tube),
                        ring_points(tube.radius), across);
    }

    void close_joint(std::size_t index) {
        std::vector<unsigned> rims = joints_[index].last.vertices;
        std::vector<glm::dvec3> directions = {-tubes_[index].end_direction};
        for (const std::size_t child : tubes_[index].children) {
            const std::vector<unsigned>& rim = joints_[child].first.vertices;
            rims.insert(rims.end(), rim.begin(), rim.end());
            directions.push_back(tubes_[child].start_direction);
        }
        std::vector<glm::dvec3> points;
        for (const unsigned vertex : rims) {
            points.push_back(model_.mesh.vertices[vertex] - tubes_[index].end);
        }
        for (const glm::dvec3& direction : directions) {
            points.push_back(joint_radius(tubes_, tubes_[index]) * direction);
        }
        for (const auto& [a, b, c] : hull_on_sphere(points)) {
            if (std::max({a, b, c}) < rims.size()) {
                model_.mesh.faces.emplace_back(rims[a], rims[b], rims[c]);
            }
        }
    }

    const std::vector<Tube>& tubes_;
    std::vector<bool> is_open_;
    bool is_root_open_ = false;
    std::vector<Joint> joints_;
    Model model_;
};

}  // namespace

glm::dvec3 Tube::at(double t) const {
    const double reach = glm::distance(start, end) / 3.0;
    const glm::dvec3 b = start + reach * start_direction, c = end - reach * end_direction;
    const double u = 1.0 - t;
    return u * u * u * start + 3.0 * u * u * t * b + 3.0 * u * t * t * c + t * t * t * end;
}

double joint_radius(const std::vector<Tube>& tubes, const Tube& tube) {
    const Tube& a = tubes[tube.children[0]];
    const Tube& b = tubes[tube.children[1]];
    const double angle_a = angle_between(-tube.end_direction, a.start_direction);
    const double angle_b = angle_between(-tube.end_direction, b.start_direction);
    const double angle_ab = angle_between(a.start_direction, b.start_direction);
    double sphere = 1.1 * std::max({ring_radius(tube), ring_radius(a), ring_radius(b)});
    const auto overlap = [&](const Tube& s, const Tube& t, double angle) {
        return kRimGap * (half_angle(ring_radius(s), sphere) + half_angle(ring_radius(t), sphere)) >
               angle;
    };
    while (overlap(tube, a, angle_a) || overlap(tube, b, angle_b) || overlap(a, b, angle_ab)) {
        sphere *= 1.02;
    }
    return sphere;
}

Model sweep_tubes(const std::string& name, const std::vector<Tube>& tubes, std::size_t open_ends) {
    return Sweep(name, tubes, open_ends).run();
}

}  // namespace zskel::models
