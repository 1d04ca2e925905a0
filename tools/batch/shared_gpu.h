#pragma once

#include <memory>
#include <string>

#include "zskel/core/error.h"
#include "zskel/visibility/backend.h"

namespace zskel::batch {

/// The GPU's process has ended, or has been replaced.
class GpuProcessLost : public GlError {
  public:
    GpuProcessLost() : GlError("the batch's GPU process has ended") {}
};

/// The backend of the GPU's process (gpu_server.h) as a backend of this one. Its calls throw
/// GlError with what went wrong there, and GpuProcessLost.
/// @param address  see GpuProcess. @param reason  why Auto takes it; empty where it was asked for.
/// @param face_px  texels along a cube face, as that process has them.
/// @throws GlError when it cannot be had, GpuProcessLost.
std::unique_ptr<Backend> open_shared_gpu(const std::string& address, int face_px,
                                         const std::string& reason);

/// Whether `backend` is one whose process has ended.
bool has_lost_process(const Backend& backend);

}  // namespace zskel::batch
