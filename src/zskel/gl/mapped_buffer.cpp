#include "zskel/gl/mapped_buffer.h"

#include "zskel/core/error.h"
#include "zskel/gl/program.h"

namespace zskel::gl {
namespace {

constexpr GLbitfield kAccess =
    GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
constexpr GLuint64 kGlance = 1'000'000'000;  // nanoseconds

}  // namespace

void MappedBuffer::reserve(const Api& gl, std::size_t wanted) {
    const auto needed = static_cast<GLsizeiptr>(wanted);
    if (needed <= capacity) return;
    gl.DeleteBuffers(1, &name);
    capacity = needed + needed / 2;
    name = make_buffer(gl, nullptr, capacity, kAccess | GL_CLIENT_STORAGE_BIT);
    bytes = static_cast<std::byte*>(gl.MapNamedBufferRange(name, 0, capacity, kAccess));
    if (bytes == nullptr) {
        gl.DeleteBuffers(1, &name);
        *this = {};
        throw GlError("a buffer cannot be mapped");
    }
}

void wait_for_writes(const Api& gl) {
    gl.MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    const GLsync done = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (gl.ClientWaitSync(done, GL_SYNC_FLUSH_COMMANDS_BIT, kGlance) == GL_TIMEOUT_EXPIRED) {
    }
    gl.DeleteSync(done);
}

}  // namespace zskel::gl
