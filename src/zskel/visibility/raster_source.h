#pragma once

#include <memory>
#include <span>

#include "zskel/gl/context.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// What all raster sources of one context share: shaders, the depth target, and the tables of one
/// map size.
class RasterPipeline;
struct RasterPipelineDeleter {
    void operator()(RasterPipeline* pipeline) const;
};
using RasterPipelinePtr = std::unique_ptr<RasterPipeline, RasterPipelineDeleter>;

/// Cube maps of `face_px` texels a side through `context`, which must outlive the pipeline.
/// @throws GlError, UsageError (face_px).
RasterPipelinePtr make_raster_pipeline(int face_px, gl::Context& context);

/// Visibility by GL's Z-buffer. Whole maps: the solid is rendered into a layered reversed-Z 32F
/// depth target with the triangle's number beside it, and read back. Records: by RecordShader,
/// where no map leaves the GPU; those of maps that are too large for it, and what a driver cannot
/// do, come from whole maps, and the log says so. Nothing is culled by its facing, so that the
/// share of back faces tells when an eye has left the solid. `solid` and `pipeline` must outlive
/// the source.
/// @throws GlError.
std::unique_ptr<VisibilitySource> make_raster_source(const Surface& solid,
                                                     RasterPipeline& pipeline);

/// `look` of several sources that were all made with this pipeline: the record shader gets their
/// eyes at once. @throws GlError.
void look_at_once(std::span<const Look> looks, RasterPipeline& pipeline);

}  // namespace zskel
