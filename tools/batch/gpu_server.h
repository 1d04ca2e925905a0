#pragma once

#include "zskel/visibility/backend.h"

namespace zskel::batch {

/// What the GPU's process of a batch is: opens the backend when the first worker asks for it, and
/// answers the workers that connect to the socket (gpu_wire.h) until it is killed. What several of
/// them want to see goes to the GPU in one batch. Returns when a GL pass has failed, which all who
/// wait for an answer are told: such a context is not trusted again.
/// @param options  Auto: a GPU, and no software in its place.
void serve_gpu(int listening, const BackendOptions& options);

}  // namespace zskel::batch
