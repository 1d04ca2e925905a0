#include "zskel/gl/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "zskel/core/error.h"

namespace zskel::gl {
namespace {

template <typename GetLength, typename GetLog>
std::string driver_log(GLuint object, GetLength get_length, GetLog get_log) {
    GLint length = 0;
    get_length(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    GLsizei written = 0;
    get_log(object, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

GLuint compile(const Api& gl, const ShaderStage& stage) {
    const GLuint shader = gl.CreateShader(stage.kind);
    const std::size_t first_line = stage.source.find('\n') + 1;
    const std::array<std::string_view, 3> parts{stage.source.substr(0, first_line),
                                                stage.definitions, stage.source.substr(first_line)};
    std::array<const GLchar*, 3> texts{};
    std::array<GLint, 3> lengths{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        texts[i] = parts[i].data();
        lengths[i] = static_cast<GLint>(parts[i].size());
    }
    gl.ShaderSource(shader, static_cast<GLsizei>(parts.size()), texts.data(), lengths.data());
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    const std::string log = driver_log(shader, gl.GetShaderiv, gl.GetShaderInfoLog);
    gl.DeleteShader(shader);
    throw GlError(fmt::format("compiling {} failed: {}", stage.name, log));
}

}  // namespace

GLuint build_program(const Api& gl, std::initializer_list<ShaderStage> stages) {
    const GLuint program = gl.CreateProgram();
    std::string names;
    for (const ShaderStage& stage : stages) {
        const GLuint shader = compile(gl, stage);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);  // goes with the program
        names += fmt::format("{}{}", names.empty() ? "" : " + ", stage.name);
    }
    gl.LinkProgram(program);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    const std::string log = driver_log(program, gl.GetProgramiv, gl.GetProgramInfoLog);
    gl.DeleteProgram(program);
    throw GlError(fmt::format("linking {} failed: {}", names, log));
}

GLint uniform(const Api& gl, GLuint program, const char* name) {
    const GLint location = gl.GetUniformLocation(program, name);
    if (location < 0) throw GlError(fmt::format("a shader has no uniform {}", name));
    return location;
}

GLuint make_buffer(const Api& gl, const void* data, GLsizeiptr bytes, GLbitfield flags) {
    GLuint buffer = 0;
    gl.CreateBuffers(1, &buffer);
    gl.NamedBufferStorage(buffer, bytes, data, flags);
    return buffer;
}

void require_complete(const Api& gl, GLuint framebuffer, std::string_view what) {
    const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw GlError(
            fmt::format("the framebuffer of {} is incomplete (status {:#06x})", what, status));
    }
}

}  // namespace zskel::gl
