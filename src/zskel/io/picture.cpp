// Pictures are drawn in horizontal bands at several samples a pixel and averaged: multisampling
// would not reach the lines that veil.frag finds, and a band's targets stay small at any picture
// size.
#include "zskel/io/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "glsl_sources.h"
#include "zskel/core/error.h"
#include "zskel/gl/api.h"
#include "zskel/gl/depth_target.h"
#include "zskel/gl/program.h"
#include "zskel/io/scene.h"

namespace zskel {
namespace {

constexpr int kMaxSamples = 3;    // along each side of a pixel
constexpr int kBandPx = 256;      // rows of the picture drawn at once
constexpr int kBorder = 8;        // rows more at a band's edges, for lines that reach across
constexpr float kNearest = 1.0f;  // reversed depth
constexpr float kFarthest = 0.0f;
constexpr float kFarVeil = 0.45f;     // how much of the farthest layer is seen
constexpr float kAboveVeil = 0.55f;   // how much the skeleton shows through the veil
constexpr float kDepthJump = 0.004f;  // of the distance: a step that is drawn as a line
constexpr float kLinePx = 0.9f;
constexpr float kLineShade = 0.38f;  // of the model's colour

// The GL side: made, used and destroyed on the context's thread.
class Painter {
  public:
    Painter(const gl::Api& gl, const Scene& scene, int samples)
        : gl_(gl),
          scene_(scene),
          samples_(samples),
          width_(scene.width_px * samples),
          height_((std::min(kBandPx, scene.height_px) + 2 * kBorder) * samples) {}

    ~Painter() {
        gl_.DepthMask(GL_TRUE);
        gl::set_reversed_depth(gl_);
        for (const GLuint program : {layer_, capsule_, veil_}) gl_.DeleteProgram(program);
        gl_.DeleteVertexArrays(static_cast<GLsizei>(arrays_.size()), arrays_.data());
        gl_.DeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
        gl_.DeleteFramebuffers(static_cast<GLsizei>(framebuffers_.size()), framebuffers_.data());
        gl_.DeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    }
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    void prepare() {
        prepare_programs();
        prepare_buffers();
        prepare_targets();
    }

    // Draws the rows from `first_row` (down from the top) on, and reads them back, rows upward.
    void draw_band(int first_row, int rows, std::vector<std::uint8_t>& rgba) {
        const float share = 1.0f / static_cast<float>(scene_.height_px);
        const float top = 1.0f - static_cast<float>(first_row - kBorder) * share;
        const float bottom = 1.0f - static_cast<float>(first_row + rows + kBorder) * share;
        const glm::mat4 clip_from_view = scene_.camera.clip_from_view(bottom, top);
        for (const GLuint program : {layer_, capsule_}) {
            gl_.UseProgram(program);
            gl_.UniformMatrix4fv(gl::uniform(gl_, program, "clip_from_view"), 1, GL_FALSE,
                                 &clip_from_view[0][0]);
        }
        const int band_height = (rows + 2 * kBorder) * samples_;
        gl_.Viewport(0, 0, width_, band_height);
        begin(framebuffers_[1], glm::vec4(1.0f), kFarthest);
        draw_layer(GL_LESS, kNearest);
        draw_veil(kFarVeil);
        draw_capsules(1.0f);
        draw_layer(GL_GREATER, kFarthest);
        draw_veil(1.0f);
        draw_capsules(kAboveVeil);
        rgba.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows * samples_) *
                    4);
        gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
        gl_.GetTextureSubImage(textures_[kColor], 0, 0, kBorder * samples_, 0, width_,
                               rows * samples_, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                               static_cast<GLsizei>(rgba.size()), rgba.data());
    }

  private:
    // Two targets, each with its depth.
    static constexpr std::size_t kSurface = 0;
    static constexpr std::size_t kSurfaceDepth = 1;
    static constexpr std::size_t kColor = 2;
    static constexpr std::size_t kColorDepth = 3;
    static constexpr std::size_t kTint = 4;  // beside kSurface

    void prepare_programs() {
        const gl::ShaderStage surface{GL_VERTEX_SHADER, "surface.vert", glsl::kSurfaceVert};
        layer_ =
            gl::build_program(gl_, {surface, {GL_FRAGMENT_SHADER, "layer.frag", glsl::kLayerFrag}});
        capsule_ =
            gl::build_program(gl_, {{GL_VERTEX_SHADER, "capsule.vert", glsl::kCapsuleVert},
                                    {GL_FRAGMENT_SHADER, "capsule.frag", glsl::kCapsuleFrag}});
        veil_ = gl::build_program(gl_, {{GL_VERTEX_SHADER, "screen.vert", glsl::kScreenVert},
                                        {GL_FRAGMENT_SHADER, "veil.frag", glsl::kVeilFrag}});
        for (const GLuint program : {layer_, capsule_}) {
            gl_.UseProgram(program);
            gl_.UniformMatrix4fv(gl::uniform(gl_, program, "view_from_world"), 1, GL_FALSE,
                                 &scene_.camera.view_from_world[0][0]);
        }
        set(capsule_, "near_plane", scene_.camera.near_plane);
        set(veil_, "ink", kLineShade * kModelColor);
        set(veil_, "jump", kDepthJump);
        set(veil_, "line_px",
            std::max(kLinePx * scene_.px_scale * static_cast<float>(samples_), 1.0f));
    }

    void prepare_buffers() {
        const auto bytes = [](const auto& items) {
            return static_cast<GLsizeiptr>(items.size() * sizeof(items[0]));
        };
        buffers_[0] = gl::make_buffer(gl_, scene_.corners.data(), bytes(scene_.corners));
        if (!scene_.capsules.empty()) {
            buffers_[1] = gl::make_buffer(gl_, scene_.capsules.data(), bytes(scene_.capsules));
        }
        gl_.CreateVertexArrays(static_cast<GLsizei>(arrays_.size()), arrays_.data());
        gl_.VertexArrayVertexBuffer(arrays_[0], 0, buffers_[0], 0, sizeof(Corner));
        for (const GLuint attribute : {0u, 1u, 2u}) {
            gl_.VertexArrayAttribFormat(arrays_[0], attribute, 3, GL_FLOAT, GL_FALSE,
                                        attribute * static_cast<GLuint>(sizeof(Vec3)));
            gl_.VertexArrayAttribBinding(arrays_[0], attribute, 0);
            gl_.EnableVertexArrayAttrib(arrays_[0], attribute);
        }
    }

    void prepare_targets() {
        gl_.CreateTextures(GL_TEXTURE_2D, static_cast<GLsizei>(textures_.size()), textures_.data());
        const std::array<GLenum, kTint + 1> formats{GL_RGBA16F, GL_DEPTH_COMPONENT32F, GL_RGBA8,
                                                    GL_DEPTH_COMPONENT32F, GL_RGBA8};
        for (std::size_t i = 0; i < textures_.size(); ++i) {
            gl_.TextureStorage2D(textures_[i], 1, formats[i], width_, height_);
        }
        gl_.CreateFramebuffers(static_cast<GLsizei>(framebuffers_.size()), framebuffers_.data());
        for (std::size_t i = 0; i < framebuffers_.size(); ++i) {
            gl_.NamedFramebufferTexture(framebuffers_[i], GL_COLOR_ATTACHMENT0, textures_[2 * i],
                                        0);
            gl_.NamedFramebufferTexture(framebuffers_[i], GL_DEPTH_ATTACHMENT, textures_[2 * i + 1],
                                        0);
            if (i == 0)
                gl_.NamedFramebufferTexture(framebuffers_[i], GL_COLOR_ATTACHMENT1,
                                            textures_[kTint], 0);
            constexpr std::array<GLenum, 2> kDrawn{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
            gl_.NamedFramebufferDrawBuffers(framebuffers_[i], i == 0 ? 2 : 1, kDrawn.data());
            gl::require_complete(gl_, framebuffers_[i], "a picture");
        }
    }

    void set(GLuint program, const char* name, float value) const {
        gl_.UseProgram(program);
        gl_.Uniform1f(gl::uniform(gl_, program, name), value);
    }
    void set(GLuint program, const char* name, const Vec3& value) const {
        gl_.UseProgram(program);
        gl_.Uniform3f(gl::uniform(gl_, program, name), value.x, value.y, value.z);
    }

    void begin(GLuint framebuffer, const glm::vec4& color, GLfloat depth) const {
        gl::set_reversed_depth(gl_);
        gl_.DepthMask(GL_TRUE);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl_.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &color[0]);
        gl_.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &depth);
    }

    // The surface's nearest layer (GL_GREATER: depth is reversed) or its farthest.
    void draw_layer(GLenum keep, float clear_depth) const {
        begin(framebuffers_[0], glm::vec4(0.0f), clear_depth);
        gl_.DepthFunc(keep);
        gl_.UseProgram(layer_);
        gl_.BindVertexArray(arrays_[0]);
        gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(scene_.corners.size()));
    }

    // Once opaque, then once more over the veil, where only what was seen before passes the depth
    // test.
    void draw_capsules(float opacity) const {
        if (scene_.capsules.empty()) return;
        set(capsule_, "opacity", opacity);
        gl_.Enable(GL_DEPTH_TEST);
        gl_.DepthFunc(opacity < 1.0f ? GL_EQUAL : GL_GREATER);
        gl_.Enable(GL_BLEND);
        gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        gl_.UseProgram(capsule_);
        gl_.BindVertexArray(arrays_[1]);
        gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers_[1]);
        gl_.DrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(scene_.capsules.size()));
    }

    // The layer drawn last, over the picture.
    void draw_veil(float strength) const {
        set(veil_, "strength", strength);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1]);
        gl_.Disable(GL_DEPTH_TEST);
        gl_.Enable(GL_BLEND);
        gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        gl_.UseProgram(veil_);
        gl_.BindTextureUnit(0, textures_[kSurface]);
        gl_.BindTextureUnit(1, textures_[kSurfaceDepth]);
        gl_.BindTextureUnit(2, textures_[kTint]);
        gl_.BindVertexArray(arrays_[1]);
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    }

    const gl::Api& gl_;
    const Scene& scene_;
    int samples_;
    int width_;
    int height_;
    GLuint layer_ = 0;
    GLuint capsule_ = 0;
    GLuint veil_ = 0;
    std::array<GLuint, 2> buffers_{};       // corners, capsules
    std::array<GLuint, 2> arrays_{};        // corners, nothing
    std::array<GLuint, 2> framebuffers_{};  // the surface's nearest layer, the picture
    std::array<GLuint, 5> textures_{};      // kSurface ... kTint
};

// Averages samples x samples blocks of a band (rows upward) into the picture's rows (downward).
void average(const std::vector<std::uint8_t>& rgba, int samples, int first_row, int rows,
             Image& image) {
    const int stride = image.width * samples;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < image.width; ++column) {
            std::array<int, 3> sum{};
            for (int i = 0; i < samples * samples; ++i) {
                const int y = (rows - 1 - row) * samples + i / samples;
                const int x = column * samples + i % samples;
                const std::size_t at =
                    (static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) +
                     static_cast<std::size_t>(x)) *
                    4;
                for (std::size_t c = 0; c < 3; ++c) sum[c] += rgba[at + c];
            }
            const std::size_t out =
                (static_cast<std::size_t>(first_row + row) * static_cast<std::size_t>(image.width) +
                 static_cast<std::size_t>(column)) *
                3;
            const int count = samples * samples;
            for (std::size_t c = 0; c < 3; ++c) {
                image.pixels[out + c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
            }
        }
    }
}

Image paint(gl::Context& context, const Scene& scene) {
    const int samples = std::min(kMaxSamples, context.info().max_texture_px / scene.width_px);
    if (samples < 1) {
        throw UsageError(fmt::format("a picture {} pixels wide: this context draws at most {}",
                                     scene.width_px, context.info().max_texture_px));
    }
    Image image = make_image(scene.width_px, scene.height_px, 3, 255);
    std::vector<std::uint8_t> rgba;
    context.run("drawing a picture", [&](const gl::Api& gl) {
        Painter painter(gl, scene, samples);
        painter.prepare();
        for (int row = 0; row < scene.height_px; row += kBandPx) {
            const int rows = std::min(kBandPx, scene.height_px - row);
            painter.draw_band(row, rows, rgba);
            average(rgba, samples, row, rows, image);
        }
    });
    return image;
}

}  // namespace

Image draw_skeleton(gl::Context& context, const Surface& surface, const SkeletonGraph& graph,
                    const PictureOptions& options, std::span<const Vec3> tints) {
    return paint(context, skeleton_scene(surface, graph, options, tints));
}

Image draw_strip(gl::Context& context, const std::vector<Frame>& frames,
                 const PictureOptions& options) {
    Surface all = frames.front().surface;
    for (const Frame& frame : frames)
        all.positions.insert(all.positions.end(), frame.surface.positions.begin(),
                             frame.surface.positions.end());
    const Camera camera = scene_camera(all, options);
    const std::ptrdiff_t stride = std::ptrdiff_t{3} * options.width_px;
    Image strip =
        make_image(options.width_px * static_cast<int>(frames.size()), options.height_px, 3, 255);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const Image picture =
            paint(context, skeleton_scene(frames[f].surface, frames[f].graph, camera, options));
        const auto columns = static_cast<std::ptrdiff_t>(frames.size());
        for (std::ptrdiff_t row = 0; row < options.height_px; ++row) {
            std::copy_n(
                picture.pixels.begin() + row * stride, stride,
                strip.pixels.begin() + (row * columns + static_cast<std::ptrdiff_t>(f)) * stride);
        }
    }
    return strip;
}

Image draw_paths(gl::Context& context, const Surface& surface,
                 std::span<const std::vector<Vec3>> paths, std::span<const Vec3> nodes,
                 const PictureOptions& options) {
    return paint(context, paths_scene(surface, paths, nodes, options));
}

}  // namespace zskel
