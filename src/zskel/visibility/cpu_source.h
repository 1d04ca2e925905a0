#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// What the CPU's Z-buffer draws.
enum class CpuDetail {
    Exact,   ///< the surface
    Levels,  ///< of a large surface a coarser level, for records of eyes that are far from it
};
/// Triangles of a solid from which on a level pays (measured).
inline constexpr std::size_t kLevelsFrom = 100'000;

/// Visibility by a Z-buffer of our own on the CPU: cube maps of `face_px` texels a side, by the
/// widest registers that the machine has. Results do not depend on the number of threads. Whole
/// maps are exact in any case. `solid` must outlive the source.
/// @throws UsageError (face_px).
std::unique_ptr<VisibilitySource> make_cpu_source(const Surface& solid, int face_px,
                                                  CpuDetail detail = CpuDetail::Exact);

/// The instruction set that the CPU source uses here, such as AVX3 or SSE4.
std::string cpu_instruction_set();

}  // namespace zskel
