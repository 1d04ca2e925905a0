#pragma once

#include <memory>

#include "zskel/gl/context.h"
#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// Near plane of the cube maps, world units: surface nearer to an eye than this is not seen.
inline constexpr float kNearPlane = 1e-6f;

/// Visibility by the Z-buffer: cube maps of `face_px` texels a side, rendered through `context` into a layered
/// reversed-Z 32F depth target with the triangle's number beside it, and read back. Nothing is culled, so
/// that the share of back faces tells when an eye has left the solid.
/// `solid` and `context` must outlive the source. @throws GlError, UsageError (face_px).
std::unique_ptr<VisibilitySource> make_raster_source(const Surface& solid, int face_px,
                                                     gl::Context& context);

}  // namespace zskel
