// The thickness at a surface point is that of Shapira, Shamir and Cohen-Or, Consistent Mesh
// Partitioning and Skeletonisation using the Shape Diameter Function (2008): rays in a cone.
// Points in a triangle follow Roberts' additive sequence for two dimensions (2018), which needs no
// random numbers; ray directions a spiral of golden angles.
#include "scoring/cover.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scoring/numbers.h"
#include "zskel/core/across.h"
#include "zskel/core/parallel.h"

namespace zskel::scoring {
namespace {

constexpr int kConeRays = 24;
constexpr double kConeAngle = std::numbers::pi / 4.0;
constexpr double kLift = 1e-5;  // of a ray's start from the surface it leaves
constexpr double kLeastThickness = 1e-4;
constexpr double kBallSpacing = 0.004;

DVec3 corner(const Surface& surface, std::size_t triangle, int k) {
    return DVec3(surface.positions[surface.triangles[triangle][k]]);
}

double area(const Surface& surface, std::size_t t) {
    const DVec3 a = corner(surface, t, 0);
    return 0.5 * glm::length(glm::cross(corner(surface, t, 1) - a, corner(surface, t, 2) - a));
}

DVec3 point_in(const Surface& surface, std::size_t t, std::size_t number) {
    const double n = static_cast<double>(number);
    double u = std::fmod(0.5 + n * 0.7548776662466927, 1.0);
    double v = std::fmod(0.5 + n * 0.5698402909980532, 1.0);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    const DVec3 a = corner(surface, t, 0);
    return a + u * (corner(surface, t, 1) - a) + v * (corner(surface, t, 2) - a);
}

std::optional<double> half_thickness(const Subject& subject, const SurfacePoint& point) {
    const Across frame(point.inward);
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const DVec3 start = point.position + point.inward * kLift;
    std::vector<double> lengths;
    for (int i = 0; i < kConeRays; ++i) {
        const double ahead = 1.0 - (1.0 - std::cos(kConeAngle)) * (i + 0.5) / kConeRays;
        const double aside = std::sqrt(1.0 - ahead * ahead);
        const auto length = subject.ray(start, point.inward * ahead + frame.at(i * golden) * aside);
        if (length) lengths.push_back(*length);
    }
    if (lengths.empty()) return std::nullopt;
    return std::max(0.5 * *median(lengths), kLeastThickness);
}

struct Ball {
    DVec3 center;
    double radius;
};

std::vector<Ball> balls_along(const Subject& subject, const SkeletonGraph& graph,
                              const CurveSides& sides) {
    std::vector<CurveSample> samples = sample_curve(graph, kBallSpacing);
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
        samples.push_back({graph.nodes[graph.edges[e].source].position, e, 0.0});
        samples.push_back({graph.nodes[graph.edges[e].target].position, e, 0.0});
    }
    std::vector<Ball> balls;
    for (const CurveSample& sample : samples) {
        const bool is_inside = sides.is_inside(sample);
        balls.push_back({sample.position, is_inside ? subject.distance_at(sample.position) : 0.0});
    }
    return balls;
}

double gap_to(const std::vector<Ball>& balls, const DVec3& point) {
    double gap = kInfinity;
    for (const Ball& ball : balls)
        gap = std::min(gap, glm::distance(point, ball.center) - ball.radius);
    return std::max(gap, 0.0);
}

}  // namespace

std::vector<SurfacePoint> spread_points(const Surface& surface, std::size_t count) {
    double total = 0.0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) total += area(surface, t);
    std::vector<SurfacePoint> out;
    double passed = 0.0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        passed += area(surface, t);
        while (out.size() < count && (static_cast<double>(out.size()) + 0.5) * total <
                                         passed * static_cast<double>(count)) {
            out.push_back({point_in(surface, t, out.size()), -DVec3(surface.triangle_normals[t])});
        }
    }
    return out;
}

std::vector<double> coverage(const Subject& subject, const SkeletonGraph& graph,
                             const std::vector<SurfacePoint>& points) {
    const std::vector<Piece> pieces = pieces_of(graph);
    std::vector<double> ratios(points.size());
    parallel_for(points.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto thickness = half_thickness(subject, points[i]);
            ratios[i] =
                thickness ? nearest_foot(pieces, points[i].position).distance / *thickness : -1.0;
        }
    });
    std::erase_if(ratios, [](double ratio) { return ratio < 0.0; });
    return ratios;
}

std::vector<double> reconstruction_gaps(const Subject& subject, const SkeletonGraph& graph,
                                        const CurveSides& sides,
                                        const std::vector<SurfacePoint>& points) {
    const std::vector<Ball> balls = balls_along(subject, graph, sides);
    std::vector<double> gaps(points.size());
    parallel_for(points.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) gaps[i] = gap_to(balls, points[i].position);
    });
    return gaps;
}

}  // namespace zskel::scoring
