#pragma once

#include <optional>
#include <span>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/gl/context.h"
#include "zskel/io/png.h"
#include "zskel/io/view.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/graph.h"

namespace zskel {

struct PictureOptions {
    int width_px = 1600;
    int height_px = 1200;
    std::optional<View> view;  ///< none: a view chosen from the model's shape
};

/// The kinds of nodes that a picture tells apart, with their sRGB colours (distinct to colour-blind
/// eyes).
inline constexpr Vec3 kTubeColor{0.20f, 0.22f, 0.26f};      ///< edges and the nodes between
inline constexpr Vec3 kEndColor{0.84f, 0.37f, 0.00f};       ///< ends, and nodes without any edge
inline constexpr Vec3 kJunctionColor{0.00f, 0.45f, 0.70f};  ///< three edges and more
inline constexpr Vec3 kModelColor{0.80f, 0.79f, 0.75f};

/// The model translucent, the skeleton inside as tubes and balls.
/// @param surface  world space; `graph` is in model space.
/// @param tints    sRGB colours of the surface's vertices; empty: kModelColor all over.
/// @throws GlError when a pass fails, UsageError for a size that cannot be drawn.
Image draw_skeleton(gl::Context& context, const Surface& surface, const SkeletonGraph& graph,
                    const PictureOptions& options, std::span<const Vec3> tints = {});

/// One picture of a strip.
struct Frame {
    Surface surface;      ///< all of a strip in one world space
    SkeletonGraph graph;  ///< model space
};

/// The frames side by side, from left to right, all seen by one camera that shows each of them
/// whole.
/// @param frames   not empty.
/// @param options  the size is that of one frame. @throws as draw_skeleton.
Image draw_strip(gl::Context& context, const std::vector<Frame>& frames,
                 const PictureOptions& options);

/// The model translucent with the seeds' ways through it, light at the start and dark at the end,
/// and the nodes where they end: the paper's Figure 3.
/// @param paths, nodes  world space. @throws as draw_skeleton.
Image draw_paths(gl::Context& context, const Surface& surface,
                 std::span<const std::vector<Vec3>> paths, std::span<const Vec3> nodes,
                 const PictureOptions& options);

}  // namespace zskel
