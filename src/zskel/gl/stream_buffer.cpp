#include "zskel/gl/stream_buffer.h"

#include "zskel/gl/program.h"

namespace zskel::gl {

void StreamBuffer::reserve(const Api& gl, std::size_t bytes) {
    const auto wanted = static_cast<GLsizeiptr>(bytes);
    if (wanted <= capacity) return;
    gl.DeleteBuffers(1, &name);
    capacity = wanted + wanted / 2;
    name = make_buffer(gl, nullptr, capacity, GL_DYNAMIC_STORAGE_BIT);
}

void StreamBuffer::fill(const Api& gl, const void* data, std::size_t bytes) {
    reserve(gl, bytes);
    if (bytes > 0) gl.NamedBufferSubData(name, 0, static_cast<GLsizeiptr>(bytes), data);
}

}  // namespace zskel::gl
