#pragma once

#include <memory>
#include <string>

#include "zskel/visibility/backend.h"

namespace zskel::batch {

/// The backend of the GPU's process (gpu_server.h) as a backend of this one. Its calls throw
/// GlError with what went wrong there, or when that process has ended.
/// @param address  see GpuProcess. @param reason  why Auto takes it; empty where it was asked for.
/// @param face_px  texels along a cube face, as that process has them.
/// @throws GlError when it cannot be had.
std::unique_ptr<Backend> open_shared_gpu(const std::string& address, int face_px,
                                         const std::string& reason);

}  // namespace zskel::batch
