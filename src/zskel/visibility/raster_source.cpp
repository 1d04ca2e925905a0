// The Z-buffer that the paper left as future work: on a face with axis direction d = (u, v, 1), 1/z
// is affine over a triangle, so with w = z and z_clip = near the depth buffer is near/z, and
// distance_radial is |d| near / depth.
#include "zskel/visibility/raster_source.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "glsl_sources.h"
#include "zskel/core/error.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/gl/api.h"
#include "zskel/gl/depth_target.h"
#include "zskel/gl/program.h"
#include "zskel/gl/stream_buffer.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/face_lists.h"
#include "zskel/visibility/record_shader.h"

namespace zskel {

constexpr int kFaces = 6;

// As the driver reads it: glMultiDrawElementsIndirect.
struct DrawCommand {
    GLuint count = 0;
    GLuint instances = 1;
    GLuint first_index = 0;
    GLint base_vertex = 0;
    GLuint base_instance = 0;  // the layer
};

// What one pass draws: for every face of every eye one command over its own stretch of indices.
struct DrawList {
    std::vector<DrawCommand> commands;
    std::vector<Triangle> corners;         // the index buffer
    std::vector<std::uint32_t> triangles;  // the number of each of `corners`
    std::vector<FaceLists> eyes;           // scratch

    void build(const Surface& surface, std::span<const Vec3> positions) {
        if (eyes.size() < positions.size()) eyes.resize(positions.size());
        parallel_for(positions.size(), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t e = begin; e < end; ++e) list_faces(surface, positions[e], eyes[e]);
        });
        commands.clear();
        triangles.clear();
        for (std::size_t e = 0; e < positions.size(); ++e) {
            for (const std::vector<std::uint32_t>& list : eyes[e].triangles) {
                commands.push_back({static_cast<GLuint>(list.size() * 3), 1,
                                    static_cast<GLuint>(triangles.size() * 3), 0,
                                    static_cast<GLuint>(commands.size())});
                triangles.insert(triangles.end(), list.begin(), list.end());
            }
        }
        corners.resize(triangles.size());
        parallel_for(triangles.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) corners[i] = surface.triangles[triangles[i]];
        });
    }
};

class RasterPipeline {
  public:
    RasterPipeline(int face_px, gl::Context& context)
        : context_(context), face_px_(face_px), directions_(cube_directions(face_px)) {
        axial_to_radial_.reserve(directions_.size());
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const double length = glm::length(texel_direction(texel_at(i, face_px), face_px));
            axial_to_radial_.push_back(
                static_cast<float>(length * static_cast<double>(kNearPlane)));
        }
        context_.run("preparing the raster pipeline", [&](const gl::Api& gl) { prepare(gl); });
    }

    ~RasterPipeline() {
        context_.release("releasing the raster pipeline", [&](const gl::Api& gl) {
            if (target_) target_->destroy(gl);
            for (const gl::StreamBuffer* buffer : {&eyes_, &indices_, &commands_})
                gl.DeleteBuffers(1, &buffer->name);
            gl.DeleteBuffers(1, &layers_);
            gl.DeleteProgram(program_);
        });
    }
    RasterPipeline(const RasterPipeline&) = delete;
    RasterPipeline& operator=(const RasterPipeline&) = delete;

    gl::Context& context() { return context_; }
    const Directions& directions() const { return directions_; }
    GLuint layer_numbers() const { return layers_; }

    // Null where maps are too large for it, or the driver cannot compile it. Compiled when first
    // asked for.
    RecordShader* record_shader() {
        if (!record_shader_ && !has_no_shader_) open_record_shader();
        return record_shader_ ? &*record_shader_ : nullptr;
    }

    // Eyes a pass: what the layers allow, no more than 64 MB of texels, and some 100 MB of indices.
    std::size_t max_batch(std::size_t triangles) const {
        const std::size_t by_layers = static_cast<std::size_t>(context_.info().max_layers) / kFaces;
        const std::size_t by_texels = (std::size_t{1} << 23) / directions_.size();
        const std::size_t by_indices = (std::size_t{1} << 22) / triangles;
        return std::max<std::size_t>(
            1, std::min({by_layers, by_texels, by_indices, std::size_t{256}}));
    }

    // Draws every face of every eye and reads distances and triangle numbers back.
    void render(const Surface& surface, GLuint vertex_array, std::span<const Vec3> eyes,
                std::span<float> distance, std::span<std::uint32_t> id) {
        list_.build(surface, eyes);
        context_.run("rendering cube maps",
                     [&](const gl::Api& gl) { draw(gl, vertex_array, eyes, distance, id); });
        const std::size_t texels = directions_.size();
        parallel_for(eyes.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t e = begin; e < end; ++e) {
                resolve(surface, eyes[e], e, distance.subspan(e * texels, texels),
                        id.subspan(e * texels, texels));
            }
        });
    }

  private:
    void open_record_shader() {
        has_no_shader_ = true;
        if (face_px_ > kMostReducedFacePx) {
            log_info("cube faces of {} texels: records come from whole maps", face_px_);
            return;
        }
        try {
            record_shader_.emplace(face_px_, context_);
            has_no_shader_ = false;
        } catch (const GlError& error) {
            log_warning("{}: records come from whole maps", error.what());
        }
    }

    void prepare(const gl::Api& gl) {
        program_ = gl::build_program(gl, {{GL_VERTEX_SHADER, "depth.vert", glsl::kDepthVert},
                                          {GL_FRAGMENT_SHADER, "depth.frag", glsl::kDepthFrag}});
        std::vector<GLuint> numbers(static_cast<std::size_t>(context_.info().max_layers));
        std::iota(numbers.begin(), numbers.end(), 0u);
        layers_ = gl::make_buffer(gl, numbers.data(),
                                  static_cast<GLsizeiptr>(numbers.size() * sizeof(GLuint)));
        gl.UseProgram(program_);
        gl.Uniform1f(gl::uniform(gl, program_, "near_plane"), kNearPlane);
        const auto faces = faces_from_world();
        gl.UniformMatrix3fv(gl::uniform(gl, program_, "face_from_world"), kFaces, GL_FALSE,
                            &faces[0][0][0]);
    }

    void draw(const gl::Api& gl, GLuint vertex_array, std::span<const Vec3> eyes,
              std::span<float> depth, std::span<std::uint32_t> id) {
        const int layers = static_cast<int>(eyes.size()) * kFaces;
        if (!target_ || target_->layers() < layers) {
            if (target_) target_->destroy(gl);
            target_.emplace(gl, face_px_, layers);
        }
        padded_eyes_.clear();
        for (const Vec3& eye : eyes) padded_eyes_.emplace_back(eye, 0.0f);
        eyes_.fill(gl, padded_eyes_.data(), padded_eyes_.size() * sizeof(glm::vec4));
        indices_.fill(gl, list_.corners.data(), list_.corners.size() * sizeof(Triangle));
        commands_.fill(gl, list_.commands.data(), list_.commands.size() * sizeof(DrawCommand));
        gl::set_reversed_depth(gl);
        target_->begin(gl);
        gl.UseProgram(program_);
        gl.VertexArrayElementBuffer(vertex_array, indices_.name);
        gl.BindVertexArray(vertex_array);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, eyes_.name);
        gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name);
        gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, layers, 0);
        target_->read(gl, layers, depth, id);
    }

    // In place: near/z becomes a distance, and a triangle's number in its draw its number in the
    // solid.
    void resolve(const Surface& surface, const Vec3& position, std::size_t eye,
                 std::span<float> texels, std::span<std::uint32_t> ids) const {
        const std::size_t per_face = texels.size() / kFaces;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            if (texels[i] > 0.0f) {
                const DrawCommand& command = list_.commands[eye * kFaces + i / per_face];
                ids[i] = list_.triangles[command.first_index / 3 + ids[i]];
                texels[i] = on_plane(surface, ids[i], position, directions_.unit[i],
                                     axial_to_radial_[i] / texels[i]);
            } else {
                texels[i] = kInfinity;
                ids[i] = kNone;
            }
        }
    }

    // The depth buffer tells what is seen, and where to a few millionths; the plane of what is seen
    // tells where to a rounding, unless it is seen too nearly from its edge.
    static float on_plane(const Surface& surface, std::uint32_t triangle, const Vec3& eye,
                          const DVec3& direction, float distance) {
        const DVec3 normal(surface.triangle_normals[triangle]);
        const Vec3& corner = surface.positions[surface.triangles[triangle].x];
        const double exact =
            glm::dot(normal, DVec3(corner) - DVec3(eye)) / glm::dot(normal, direction);
        const bool agree = std::abs(exact - static_cast<double>(distance)) <=
                           kPlaneAgreement * static_cast<double>(distance);
        return agree ? static_cast<float>(exact) : distance;
    }
    static constexpr double kPlaneAgreement = 1e-3;

    gl::Context& context_;
    int face_px_;
    Directions directions_;
    std::vector<float> axial_to_radial_;  // |d| times the near plane
    DrawList list_;
    std::vector<glm::vec4> padded_eyes_;
    std::optional<gl::DepthTarget> target_;
    std::optional<RecordShader> record_shader_;
    bool has_no_shader_ = false;
    GLuint program_ = 0;
    GLuint layers_ = 0;
    gl::StreamBuffer eyes_;
    gl::StreamBuffer indices_;
    gl::StreamBuffer commands_;
};

namespace {

class RasterSource : public VisibilitySource {
  public:
    RasterSource(const Surface& solid, RasterPipeline& pipeline)
        : VisibilitySource(solid, pipeline.directions()), pipeline_(pipeline) {}

    ~RasterSource() override {
        if (shaded_) pipeline_.record_shader()->release(*shaded_);
        if (vertex_array_ == 0) return;
        pipeline_.context().release("releasing the raster source", [&](const gl::Api& gl) {
            gl.DeleteVertexArrays(1, &vertex_array_);
            gl.DeleteBuffers(1, &vertices_);
        });
    }

    void look(std::span<const Vec3> eyes, std::span<EyeRecord> records) override {
        const Look one{this, eyes, records};
        look_at_once({&one, 1}, pipeline_);
    }

    // Null where the record shader cannot do it, and the log says why.
    const RecordShader::Solid* shaded() {
        RecordShader* shader = pipeline_.record_shader();
        if (shader != nullptr && !shaded_ && !too_large_) {
            shaded_ = shader->upload(solid());
            too_large_ = !shaded_;
            if (too_large_) {
                log_warning(
                    "{} triangles are too many for the driver's compute shaders: "
                    "records come from whole maps",
                    solid().triangles.size());
            }
        }
        return shaded_ ? &*shaded_ : nullptr;
    }

    void look_by_maps(std::span<const Vec3> eyes, std::span<EyeRecord> records) {
        VisibilitySource::look(eyes, records);
    }

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        const std::size_t texels = directions().size();
        maps.resize(eyes.size(), texels);
        if (vertex_array_ == 0) {
            pipeline_.context().run("preparing the raster source",
                                    [&](const gl::Api& gl) { upload(gl); });
        }
        const std::size_t batch = pipeline_.max_batch(solid().triangles.size());
        for (std::size_t first = 0; first < eyes.size(); first += batch) {
            const std::size_t count = std::min(batch, eyes.size() - first);
            pipeline_.render(solid(), vertex_array_, eyes.subspan(first, count),
                             std::span(maps.distance).subspan(first * texels, count * texels),
                             std::span(maps.id).subspan(first * texels, count * texels));
        }
    }

    // The eyes whose records the driver cut short.
    void look_again(std::span<const Vec3> eyes, std::span<EyeRecord> records) {
        std::vector<std::size_t> cut;
        std::vector<Vec3> again;
        for (std::size_t e = 0; e < eyes.size(); ++e) {
            if (records[e].hit_fraction >= 0.0f) continue;
            cut.push_back(e);
            again.push_back(eyes[e]);
        }
        if (cut.empty()) return;
        if (!std::exchange(has_warned_, true)) {
            log_warning(
                "the driver cuts long compute shaders short ({} of {} eyes): "
                "their records come from whole maps",
                cut.size(), eyes.size());
        }
        std::vector<EyeRecord> mended(cut.size());
        look_by_maps(again, mended);
        for (std::size_t i = 0; i < cut.size(); ++i) records[cut[i]] = mended[i];
    }

  private:
    void upload(const gl::Api& gl) {
        vertices_ =
            gl::make_buffer(gl, solid().positions.data(),
                            static_cast<GLsizeiptr>(solid().positions.size() * sizeof(Vec3)));
        gl.CreateVertexArrays(1, &vertex_array_);
        gl.VertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(Vec3));
        gl.VertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, 0);
        gl.VertexArrayAttribBinding(vertex_array_, 0, 0);
        gl.EnableVertexArrayAttrib(vertex_array_, 0);
        gl.VertexArrayVertexBuffer(vertex_array_, 1, pipeline_.layer_numbers(), 0, sizeof(GLuint));
        gl.VertexArrayAttribIFormat(vertex_array_, 1, 1, GL_UNSIGNED_INT, 0);
        gl.VertexArrayAttribBinding(vertex_array_, 1, 1);
        gl.VertexArrayBindingDivisor(vertex_array_, 1, 1);
        gl.EnableVertexArrayAttrib(vertex_array_, 1);
    }

    RasterPipeline& pipeline_;
    std::optional<RecordShader::Solid> shaded_;
    bool too_large_ = false;
    bool has_warned_ = false;
    GLuint vertex_array_ = 0;  // of whole maps, made when the first is asked for
    GLuint vertices_ = 0;
};

}  // namespace

void RasterPipelineDeleter::operator()(RasterPipeline* pipeline) const {
    delete pipeline;
}

RasterPipelinePtr make_raster_pipeline(int face_px, gl::Context& context) {
    return RasterPipelinePtr(new RasterPipeline(face_px, context));
}

std::unique_ptr<VisibilitySource> make_raster_source(const Surface& solid,
                                                     RasterPipeline& pipeline) {
    return std::make_unique<RasterSource>(solid, pipeline);
}

// By the record shader; what it cannot do is drawn, read back and reduced here.
void look_at_once(std::span<const Look> looks, RasterPipeline& pipeline) {
    std::vector<RecordShader::Job> jobs;
    std::vector<const Look*> shaded;
    for (const Look& look : looks) {
        auto& source = static_cast<RasterSource&>(*look.source);
        if (const RecordShader::Solid* solid = source.shaded()) {
            jobs.push_back({solid, look.eyes, look.records});
            shaded.push_back(&look);
        } else {
            source.look_by_maps(look.eyes, look.records);
        }
    }
    if (!jobs.empty()) pipeline.record_shader()->look(jobs);
    for (const Look* look : shaded)
        static_cast<RasterSource&>(*look->source).look_again(look->eyes, look->records);
}

}  // namespace zskel
