#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "zskel/gl/api.h"

namespace zskel::gl {

struct ShaderStage {
    GLenum kind;
    std::string_view name;  ///< the file's, for messages
    std::string_view source;
    std::string definitions = {};  ///< lines put in after the first, which says the version
};

/// Compiles and links. @throws GlError with the stage, the file and the driver's log.
GLuint build_program(const Api& gl, std::initializer_list<ShaderStage> stages);

/// Location of a uniform. @throws GlError when the program has none of that name.
GLint uniform(const Api& gl, GLuint program, const char* name);

/// A buffer of fixed size with the given content.
GLuint make_buffer(const Api& gl, const void* data, GLsizeiptr bytes, GLbitfield flags = 0);

/// @throws GlError unless the framebuffer is complete.
void require_complete(const Api& gl, GLuint framebuffer, std::string_view what);

}  // namespace zskel::gl
