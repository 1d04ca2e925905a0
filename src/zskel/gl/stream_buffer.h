#pragma once

#include <cstddef>

#include "zskel/gl/api.h"

namespace zskel::gl {

/// A buffer that grows to the largest content it has held.
struct StreamBuffer {
    GLuint name = 0;
    GLsizeiptr capacity = 0;

    /// Makes room for `bytes`; what was in it may be gone.
    void reserve(const Api& gl, std::size_t bytes);
    void fill(const Api& gl, const void* data, std::size_t bytes);
};

}  // namespace zskel::gl
