#pragma once

#include <cstddef>

#include "zskel/gl/api.h"

namespace zskel::gl {

/// Memory of the program's own that shaders write to. It grows to the largest content it has held.
/// (A buffer of the driver's that is read back may be moved to where the GPU is slow to write: on
/// an H200 every later pass took four times as long.)
struct MappedBuffer {
    GLuint name = 0;
    GLsizeiptr capacity = 0;
    std::byte* bytes = nullptr;

    /// Makes room; what was in it may be gone.
    void reserve(const Api& gl, std::size_t wanted);
};

/// Waits until what was given to the GPU is done, and what it wrote to mapped buffers is there.
void wait_for_writes(const Api& gl);

}  // namespace zskel::gl
