// The winding number sums the triangles' solid angles (van Oosterom and Strackee 1983).
#include "triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace zskel::models {
namespace {

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::distance(p, a + t * ab);
}

double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const auto is_left_of = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
    };
    if (is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a)) {
        return std::abs(glm::dot(p - a, normal)) / glm::length(normal);
    }
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

}  // namespace

void round_vertices(Triangles& mesh, double step) {
    for (glm::dvec3& v : mesh.vertices) {
        v = glm::round(v / step) * step;
    }
}

double distance_to_mesh(const Triangles& mesh, const glm::dvec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::uvec3& f : mesh.faces) {
        nearest = std::min(nearest, distance_to_triangle(p, mesh.vertices[f.x], mesh.vertices[f.y],
                                                         mesh.vertices[f.z]));
    }
    return nearest;
}

double winding_number(const Triangles& mesh, const glm::dvec3& p) {
    double solid_angle = 0.0;
    for (const glm::uvec3& f : mesh.faces) {
        const glm::dvec3 a = mesh.vertices[f.x] - p;
        const glm::dvec3 b = mesh.vertices[f.y] - p;
        const glm::dvec3 c = mesh.vertices[f.z] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double volume = glm::dot(a, glm::cross(b, c));
        const double side =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        solid_angle += 2.0 * std::atan2(volume, side);
    }
    return solid_angle / (4.0 * std::numbers::pi);
}

}  // namespace zskel::models
