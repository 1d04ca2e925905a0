#pragma once

#include <memory>
#include <string>

#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// Visibility by a Z-buffer of our own on the CPU: cube maps of `face_px` texels a side, by the
/// widest registers that the machine has. Results do not depend on the number of threads.
/// `solid` must outlive the source.
/// @throws UsageError (face_px).
std::unique_ptr<VisibilitySource> make_cpu_source(const Surface& solid, int face_px);

/// The instruction set that the CPU source uses here, such as AVX3 or SSE4.
std::string cpu_instruction_set();

}  // namespace zskel
