#include "zskel/io/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "zskel/core/error.h"

namespace zskel {
namespace {

constexpr int kMinPx = 16;
constexpr int kMaxPx = 8192;
constexpr float kSmoothCosine = 0.75f;  // a corner this far from its vertex's normal is a crease

// Radii for a picture 1200 pixels high.
constexpr float kReferencePx = 1200.0f;
constexpr float kTubePx = 3.5f;
constexpr float kNodePx = 6.4f;
constexpr float kMarkPx = 11.0f;
constexpr float kPathPx = 2.4f;  // of few paths; many are drawn thinner
constexpr float kFewPaths = 20.0f;
constexpr float kPathNodePx = 8.0f;

Capsule tube(const Vec3& a, const Vec3& b, float radius, const Vec3& color_a, const Vec3& color_b) {
    return {glm::vec4(a, radius), glm::vec4(b, 0.0f), glm::vec4(color_a, 1.0f),
            glm::vec4(color_b, 1.0f)};
}
Capsule ball(const Vec3& at, float radius, const Vec3& color, float lift = 0.0f) {
    Capsule capsule = tube(at, at, radius, color, color);
    capsule.b_lift.w = lift;
    return capsule;
}

// Smooth shading, but flat where the surface has a crease.
std::vector<Corner> corners_of(const Surface& surface, std::span<const Vec3> tints) {
    std::vector<Corner> corners;
    corners.reserve(surface.triangles.size() * 3);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const Vec3& flat = surface.triangle_normals[t];
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = surface.triangles[t][k];
            const Vec3& smooth = surface.vertex_normals[vertex];
            const bool is_crease = glm::dot(smooth, flat) < kSmoothCosine && flat != Vec3(0.0f);
            corners.push_back({surface.positions[vertex], is_crease ? flat : smooth,
                               tints.empty() ? kModelColor : tints[vertex]});
        }
    }
    return corners;
}

Scene make_scene(const Surface& surface, const Camera& camera, const PictureOptions& options,
                 std::span<const Vec3> tints = {}) {
    const float smaller = static_cast<float>(std::min(options.height_px, options.width_px * 3 / 4));
    return {camera,           corners_of(surface, tints), {},
            options.width_px, options.height_px,          smaller / kReferencePx};
}

// World radius of what is to be `px` pixels of the reference picture thick.
float world_radius(const Scene& scene, float px) {
    return px * scene.px_scale * scene.camera.world_per_px(scene.height_px);
}

}  // namespace

Camera scene_camera(const Surface& surface, const PictureOptions& options) {
    for (const int px : {options.width_px, options.height_px}) {
        if (px < kMinPx || px > kMaxPx) {
            throw UsageError(fmt::format("a picture of {} x {} pixels: give {} to {}",
                                         options.width_px, options.height_px, kMinPx, kMaxPx));
        }
    }
    return aim_camera(surface, options.view, options.width_px, options.height_px);
}

Scene skeleton_scene(const Surface& surface, const SkeletonGraph& graph,
                     const PictureOptions& options, std::span<const Vec3> tints) {
    return skeleton_scene(surface, graph, scene_camera(surface, options), options, tints);
}

Scene skeleton_scene(const Surface& surface, const SkeletonGraph& graph, const Camera& camera,
                     const PictureOptions& options, std::span<const Vec3> tints) {
    Scene scene = make_scene(surface, camera, options, tints);
    const auto place = [&](std::uint32_t node) {
        return surface.world_from_model.to_world(graph.nodes[node].position);
    };
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        scene.capsules.push_back(tube(place(edge.source), place(edge.target),
                                      world_radius(scene, kTubePx), kTubeColor, kTubeColor));
    }
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
        const bool is_plain = degrees[node] == 2;
        const Vec3 color = is_plain ? kTubeColor : degrees[node] < 2 ? kEndColor : kJunctionColor;
        scene.capsules.push_back(
            ball(place(node), world_radius(scene, is_plain ? kNodePx : kMarkPx), color));
    }
    return scene;
}

Scene paths_scene(const Surface& surface, std::span<const std::vector<Vec3>> paths,
                  std::span<const Vec3> nodes, const PictureOptions& options) {
    const Vec3 start_color(0.34f, 0.71f, 0.91f);
    const Vec3 end_color(0.05f, 0.15f, 0.40f);
    Scene scene = make_scene(surface, scene_camera(surface, options), options);
    const float many = std::max(static_cast<float>(paths.size()) / kFewPaths, 1.0f);
    const float radius = world_radius(scene, kPathPx * std::pow(many, -0.15f));
    for (const std::vector<Vec3>& path : paths) {
        const auto color = [&](std::size_t i) {
            return glm::mix(start_color, end_color,
                            static_cast<float>(i) / static_cast<float>(path.size()));
        };
        if (!path.empty()) scene.capsules.push_back(ball(path.front(), 1.8f * radius, start_color));
        for (std::size_t i = 1; i < path.size(); ++i) {
            scene.capsules.push_back(tube(path[i - 1], path[i], radius, color(i - 1), color(i)));
        }
    }
    for (const Vec3& node : nodes) {
        scene.capsules.push_back(
            ball(node, world_radius(scene, kPathNodePx), kEndColor, 0.4f * scene.camera.distance));
    }
    return scene;
}

}  // namespace zskel
