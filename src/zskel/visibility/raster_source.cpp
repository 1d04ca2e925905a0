// The Z-buffer that the paper left as future work: on a face with axis direction d = (u, v, 1), 1/z is
// affine over a triangle, so with w = z and z_clip = near the depth buffer is near/z, and distance_radial
// is |d| near / depth.
#include "zskel/visibility/raster_source.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "glsl_sources.h"
#include "zskel/core/parallel.h"
#include "zskel/gl/api.h"
#include "zskel/gl/depth_target.h"
#include "zskel/gl/program.h"
#include "zskel/visibility/cube_map.h"

namespace zskel {

constexpr int kFaces = 6;

class RasterPipeline {
  public:
    RasterPipeline(int face_px, gl::Context& context)
        : context_(context), face_px_(face_px), directions_(cube_directions(face_px)) {
        axial_to_radial_.reserve(directions_.size());
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const double length = glm::length(texel_direction(texel_at(i, face_px), face_px));
            axial_to_radial_.push_back(static_cast<float>(length * static_cast<double>(kNearPlane)));
        }
        context_.run("preparing the raster pipeline", [&](const gl::Api& gl) { prepare(gl); });
    }

    ~RasterPipeline() {
        context_.release("releasing the raster pipeline", [&](const gl::Api& gl) {
            if (target_) target_->destroy(gl);
            gl.DeleteBuffers(1, &eyes_);
            gl.DeleteProgram(program_);
        });
    }
    RasterPipeline(const RasterPipeline&) = delete;
    RasterPipeline& operator=(const RasterPipeline&) = delete;

    gl::Context& context() { return context_; }
    const Directions& directions() const { return directions_; }

    // Eyes a pass: what the layers allow, and no more than 64 MB of texels.
    std::size_t max_batch() const {
        const std::size_t by_layers = static_cast<std::size_t>(context_.info().max_layers) / kFaces;
        const std::size_t by_memory = (std::size_t{1} << 23) / directions_.size();
        return std::clamp<std::size_t>(by_memory, 1, std::min<std::size_t>(by_layers, 256));
    }

    // One pass: `elements` indices of the bound solid for every face of every eye. Leaves near/z in `depth`.
    void draw(const gl::Api& gl, GLuint vertex_array, std::size_t elements, std::span<const Vec3> eyes,
              std::span<float> depth, std::span<std::uint32_t> id) {
        const int layers = static_cast<int>(eyes.size()) * kFaces;
        if (!target_ || target_->layers() < layers) {
            if (target_) target_->destroy(gl);
            target_.emplace(gl, face_px_, layers);
        }
        std::vector<glm::vec4> padded;
        padded.reserve(eyes.size());
        for (const Vec3& eye : eyes) padded.emplace_back(eye, 0.0f);
        gl.NamedBufferSubData(eyes_, 0, static_cast<GLsizeiptr>(padded.size() * sizeof(glm::vec4)),
                              padded.data());
        gl::set_reversed_depth(gl);
        target_->begin(gl);
        gl.UseProgram(program_);
        gl.BindVertexArray(vertex_array);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, eyes_);
        gl.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(elements), GL_UNSIGNED_INT, nullptr,
                                 layers);
        target_->read(gl, layers, depth, id);
    }

    // In place: near/z becomes a distance; what was never drawn has depth 0 and becomes +inf.
    void to_radial(std::span<float> texels) const {
        for (std::size_t i = 0; i < texels.size(); ++i) {
            texels[i] = texels[i] > 0.0f ? axial_to_radial_[i] / texels[i] : kInfinity;
        }
    }

  private:
    void prepare(const gl::Api& gl) {
        program_ = gl::build_program(gl, {{GL_VERTEX_SHADER, "depth.vert", glsl::kDepthVert},
                                          {GL_FRAGMENT_SHADER, "depth.frag", glsl::kDepthFrag}});
        eyes_ = gl::make_buffer(gl, nullptr, static_cast<GLsizeiptr>(max_batch() * sizeof(glm::vec4)),
                                GL_DYNAMIC_STORAGE_BIT);
        gl.UseProgram(program_);
        gl.Uniform1f(gl::uniform(gl, program_, "near_plane"), kNearPlane);
        std::array<glm::mat3, kFaces> face_from_world{};
        for (std::size_t f = 0; f < kFaces; ++f) {
            const CubeFace& face = cube_faces()[f];
            face_from_world[f] = glm::transpose(glm::mat3(face.right, face.up, face.forward));
        }
        gl.UniformMatrix3fv(gl::uniform(gl, program_, "face_from_world"), kFaces, GL_FALSE,
                            &face_from_world[0][0][0]);
    }

    gl::Context& context_;
    int face_px_;
    Directions directions_;
    std::vector<float> axial_to_radial_;  // |d| times the near plane
    std::optional<gl::DepthTarget> target_;
    GLuint program_ = 0;
    GLuint eyes_ = 0;
};

namespace {

class RasterSource : public VisibilitySource {
  public:
    RasterSource(const Surface& solid, RasterPipeline& pipeline)
        : VisibilitySource(solid, pipeline.directions()), pipeline_(pipeline) {
        pipeline_.context().run("preparing the raster source", [&](const gl::Api& gl) { upload(gl); });
    }

    ~RasterSource() override {
        pipeline_.context().release("releasing the raster source", [&](const gl::Api& gl) {
            gl.DeleteVertexArrays(1, &vertex_array_);
            const GLuint buffers[] = {vertices_, indices_};
            gl.DeleteBuffers(2, buffers);
        });
    }

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        const std::size_t texels = directions().size();
        maps.resize(eyes.size(), texels);
        const std::size_t batch = pipeline_.max_batch();
        for (std::size_t first = 0; first < eyes.size(); first += batch) {
            const std::size_t count = std::min(batch, eyes.size() - first);
            pipeline_.context().run("rendering cube maps", [&](const gl::Api& gl) {
                pipeline_.draw(gl, vertex_array_, solid().triangles.size() * 3, eyes.subspan(first, count),
                               std::span(maps.distance).subspan(first * texels, count * texels),
                               std::span(maps.id).subspan(first * texels, count * texels));
            });
        }
        parallel_for(eyes.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                pipeline_.to_radial(std::span(maps.distance).subspan(i * texels, texels));
            }
        });
    }

  private:
    void upload(const gl::Api& gl) {
        const Surface& surface = solid();
        vertices_ = gl::make_buffer(gl, surface.positions.data(),
                                    static_cast<GLsizeiptr>(surface.positions.size() * sizeof(Vec3)));
        indices_ = gl::make_buffer(gl, surface.triangles.data(),
                                   static_cast<GLsizeiptr>(surface.triangles.size() * sizeof(Triangle)));
        gl.CreateVertexArrays(1, &vertex_array_);
        gl.VertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(Vec3));
        gl.VertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, 0);
        gl.VertexArrayAttribBinding(vertex_array_, 0, 0);
        gl.EnableVertexArrayAttrib(vertex_array_, 0);
        gl.VertexArrayElementBuffer(vertex_array_, indices_);
    }

    RasterPipeline& pipeline_;
    GLuint vertex_array_ = 0;
    GLuint vertices_ = 0;
    GLuint indices_ = 0;
};

}  // namespace

void RasterPipelineDeleter::operator()(RasterPipeline* pipeline) const { delete pipeline; }

RasterPipelinePtr make_raster_pipeline(int face_px, gl::Context& context) {
    return RasterPipelinePtr(new RasterPipeline(face_px, context));
}

std::unique_ptr<VisibilitySource> make_raster_source(const Surface& solid, RasterPipeline& pipeline) {
    return std::make_unique<RasterSource>(solid, pipeline);
}

}  // namespace zskel
