#include "teapot.h"

#include <algorithm>
#include <limits>

namespace zskel::models {
namespace {

constexpr int kStepsPerSpan = 4;  // nodes from one cube's centre to the next
constexpr int kRelaxations = 2;
constexpr int kGridSteps = 4;  // of the triangles that are measured

using Cubes = std::vector<glm::ivec3>;

// Without the cubes at its upright edges the belly comes out round.
Cubes belly() {
    Cubes cubes;
    for (int x = 0; x < 5; ++x) {
        for (int y = 0; y < 4; ++y) {
            for (int z = 0; z < 5; ++z) {
                const bool is_corner = (x == 0 || x == 4) && (z == 0 || z == 4);
                if (!is_corner) {
                    cubes.emplace_back(x, y, z);
                }
            }
        }
    }
    return cubes;
}

// Limbs start in the belly's middle; of those cubes only what sticks out counts.
const Cubes kSpout = {{2, 1, 2}, {4, 1, 2}, {5, 1, 2}, {6, 1, 2},
                      {6, 2, 2}, {7, 2, 2}, {7, 3, 2}, {8, 3, 2}};
const Cubes kKnob = {{2, 1, 2}, {2, 3, 2}, {2, 4, 2}, {2, 5, 2}};
const Cubes kHandle = {{2, 1, 2},  {0, 3, 2},  {-1, 3, 2}, {-2, 3, 2}, {-3, 3, 2}, {-3, 2, 2},
                       {-3, 1, 2}, {-3, 0, 2}, {-2, 0, 2}, {-1, 0, 2}, {0, 0, 2},  {2, 1, 2}};

/// A uniform cubic B-spline, as the surface round it is one; from its first point to its last.
std::vector<glm::dvec3> spline_through(const Cubes& cubes) {
    std::vector<glm::dvec3> control;
    for (const glm::ivec3& cube : cubes) {
        control.push_back(glm::dvec3(cube) + 0.5);
    }
    control.insert(control.begin(), 2, control.front());
    control.insert(control.end(), 2, control.back());
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i + 3 < control.size(); ++i) {
        for (int step = 0; step < kStepsPerSpan; ++step) {
            const double t = step / static_cast<double>(kStepsPerSpan);
            const double s = 1.0 - t;
            points.push_back((s * s * s * control[i] +
                              (3.0 * t * t * t - 6.0 * t * t + 4.0) * control[i + 1] +
                              (3.0 * s * s * s - 6.0 * s * s + 4.0) * control[i + 2] +
                              t * t * t * control[i + 3]) /
                             6.0);
        }
    }
    points.push_back(control.back());
    return points;
}

/// Every vertex goes half the way to the middle of its neighbours, so that steps become slopes.
Quads relaxed(Quads quads) {
    for (int round = 0; round < kRelaxations; ++round) {
        std::vector<glm::dvec3> sums(quads.vertices.size(), glm::dvec3(0.0));
        std::vector<double> counts(quads.vertices.size(), 0.0);
        for (const glm::uvec4& face : quads.faces) {
            for (int k = 0; k < 4; ++k) {
                sums[face[k]] += quads.vertices[face[(k + 1) % 4]];
                counts[face[k]] += 1.0;
            }
        }
        for (std::size_t v = 0; v < quads.vertices.size(); ++v) {
            quads.vertices[v] = 0.5 * (quads.vertices[v] + sums[v] / counts[v]);
        }
    }
    return quads;
}

void add_limb(Truth& truth, const std::string& name, const Cubes& cubes) {
    const std::vector<glm::dvec3> points = spline_through(cubes);
    const bool is_loop = cubes.front() == cubes.back();
    TruthLimb limb{name, {0}, false};
    for (std::size_t i = 1; i + (is_loop ? 1 : 0) < points.size(); ++i) {
        truth.nodes.push_back({points[i], 0.0});
        truth.edges.emplace_back(limb.nodes.back(), truth.nodes.size() - 1);
        limb.nodes.push_back(truth.nodes.size() - 1);
    }
    if (is_loop) {
        truth.edges.emplace_back(limb.nodes.back(), 0);
    }
    truth.limbs.push_back(limb);
}

}  // namespace

Model make_teapot() {
    Cubes cubes = belly();
    for (const Cubes& limb : {kSpout, kKnob, kHandle}) {
        for (const glm::ivec3& cube : limb) {
            if (std::find(cubes.begin(), cubes.end(), cube) == cubes.end()) {
                cubes.push_back(cube);
            }
        }
    }
    Quads quads = relaxed(cube_boundary(cubes));
    Model model;
    model.name = "teapot";
    model.truth.nodes.push_back({glm::dvec3(kSpout.front()) + 0.5, 0.0});
    add_limb(model.truth, "spout", kSpout);
    add_limb(model.truth, "knob", kKnob);
    add_limb(model.truth, "handle", kHandle);

    // Into the unit cube.
    const Triangles first = triangulate(smooth_patches(quads), kGridSteps);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::dvec3& v : first.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    const glm::dvec3 size = high - low;
    const double scale = 1.0 / std::max({size.x, size.y, size.z});
    const auto place = [&](const glm::dvec3& p) { return scale * (p - 0.5 * (low + high)); };
    for (glm::dvec3& v : quads.vertices) {
        v = place(v);
    }
    model.patches = smooth_patches(quads);
    model.mesh = triangulate(model.patches, kGridSteps);
    for (Truth::Node& node : model.truth.nodes) {
        node.position = place(node.position);
        node.radius = distance_to_mesh(model.mesh, node.position);
    }
    model.expected = {.faces = 2 * kGridSteps * kGridSteps * model.patches.size(),
                      .genus = 1,
                      .ends = 2,
                      .cycles = 1};
    return model;
}

}  // namespace zskel::models
