#include "zskel/gl/depth_target.h"

#include "zskel/core/assert.h"
#include "zskel/gl/program.h"

namespace zskel::gl {

DepthTarget::DepthTarget(const Api& gl, int px, int layers) : px_(px), layers_(layers) {
    gl.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &depth_);
    gl.TextureStorage3D(depth_, 1, GL_DEPTH_COMPONENT32F, px, px, layers);
    gl.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id_);
    gl.TextureStorage3D(id_, 1, GL_R32UI, px, px, layers);
    gl.CreateFramebuffers(1, &framebuffer_);
    gl.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
    gl.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, id_, 0);
    gl.NamedFramebufferDrawBuffer(framebuffer_, GL_COLOR_ATTACHMENT0);
    require_complete(gl, framebuffer_, "the depth target");
}

void DepthTarget::destroy(const Api& gl) {
    gl.DeleteFramebuffers(1, &framebuffer_);
    gl.DeleteTextures(1, &id_);
    gl.DeleteTextures(1, &depth_);
}

void DepthTarget::begin(const Api& gl) const {
    const GLfloat far = 0.0f;
    const GLuint nothing[4] = {0xFFFFFFFFu, 0, 0, 0};
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.Viewport(0, 0, px_, px_);
    gl.ClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far);
    gl.ClearNamedFramebufferuiv(framebuffer_, GL_COLOR, 0, nothing);
}

void DepthTarget::read(const Api& gl, int layers, std::span<float> depth,
                       std::span<std::uint32_t> id) const {
    ZSKEL_ASSERT(depth.size() == static_cast<std::size_t>(layers) * px_ * px_, "one value a texel");
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.GetTextureSubImage(depth_, 0, 0, 0, 0, px_, px_, layers, GL_DEPTH_COMPONENT, GL_FLOAT,
                          static_cast<GLsizei>(depth.size_bytes()), depth.data());
    gl.GetTextureSubImage(id_, 0, 0, 0, 0, px_, px_, layers, GL_RED_INTEGER, GL_UNSIGNED_INT,
                          static_cast<GLsizei>(id.size_bytes()), id.data());
}

void set_reversed_depth(const Api& gl) {
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
}

}  // namespace zskel::gl
