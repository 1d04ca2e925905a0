#pragma once

#include <span>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/io/picture.h"
#include "zskel/io/view.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/graph.h"

namespace zskel {

/// A tube with round ends, or a ball when both ends are one; laid out as capsule.vert reads it.
/// World space.
struct Capsule {
    glm::vec4 a_radius;
    glm::vec4 b_lift;  // lift: how much nearer it counts as being, world units
    glm::vec4 color_a;
    glm::vec4 color_b;
};

/// A triangle's corner with the normal it is shaded by, and its colour.
struct Corner {
    Vec3 position;
    Vec3 normal;
    Vec3 tint;
};

/// What a picture shows, ready to be drawn.
struct Scene {
    Camera camera;
    std::vector<Corner> corners;
    std::vector<Capsule> capsules;
    int width_px = 0;
    int height_px = 0;
    float px_scale = 1.0f;  ///< lines and radii, against a picture 1200 pixels high
};

/// The camera that the options ask for. @throws UsageError for a size that cannot be drawn.
Camera scene_camera(const Surface& surface, const PictureOptions& options);

/// The model with a skeleton (model space) in it. @throws UsageError for a size that cannot be
/// drawn.
/// @param tints  see draw_skeleton.
Scene skeleton_scene(const Surface& surface, const SkeletonGraph& graph,
                     const PictureOptions& options, std::span<const Vec3> tints = {});

/// The model with a skeleton in it, seen by a camera that was aimed before.
Scene skeleton_scene(const Surface& surface, const SkeletonGraph& graph, const Camera& camera,
                     const PictureOptions& options, std::span<const Vec3> tints = {});

/// The model with paths and nodes (world space) in it. @throws UsageError for a size that cannot be
/// drawn.
Scene paths_scene(const Surface& surface, std::span<const std::vector<Vec3>> paths,
                  std::span<const Vec3> nodes, const PictureOptions& options);

}  // namespace zskel
