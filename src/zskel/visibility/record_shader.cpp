#include "zskel/visibility/record_shader.h"

#include <fmt/format.h>

#include <algorithm>

#include "glsl_sources.h"
#include "zskel/core/assert.h"
#include "zskel/gl/program.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/triangle_clusters.h"

namespace zskel {
namespace {

constexpr std::size_t kMostGroups = 65535;  // of threads, in one dispatch: what every driver takes
// Of a workgroup. Measured: 128 and 512 are slower on a data-centre GPU, more than 64 on llvmpipe.
constexpr int kThreadsOnHardware = 256;
constexpr int kThreadsInSoftware = 64;
constexpr GLuint kPatience = 64;
constexpr GLfloat kCutShort = -1.0f;  // hit_fraction of a record that is none

template <typename T>
GLsizeiptr bytes_of(const T& items) {
    return static_cast<GLsizeiptr>(items.size() * sizeof(*items.data()));
}

}  // namespace

RecordShader::RecordShader(int face_px, gl::Context& context) : context_(context) {
    ZSKEL_ASSERT(face_px <= kMostReducedFacePx, "the map fits");
    std::vector<float> weights;
    for (int row = 0; row < face_px; ++row) {
        for (int column = 0; column < face_px; ++column)
            weights.push_back(static_cast<float>(texel_share({0, column, row}, face_px)));
    }
    context_.run("preparing the record shader", [&](const gl::Api& gl) {
        program_ = gl::build_program(
            gl,
            {{GL_COMPUTE_SHADER, "records.comp", glsl::kRecordsComp,
              fmt::format("#define kThreads {}u\n#define kTexels {}u\n",
                          context_.info().kind == gl::ContextKind::EglHardware ? kThreadsOnHardware
                                                                               : kThreadsInSoftware,
                          6 * face_px * face_px)}});
        gl.UseProgram(program_);
        gl.Uniform1i(gl::uniform(gl, program_, "face_px"), face_px);
        // A driver that sees through the loop may leave it out, and its uniform.
        gl.Uniform1ui(gl.GetUniformLocation(program_, "patience"), kPatience);
        gl.Uniform1f(gl::uniform(gl, program_, "near_plane"), kNearPlane);
        gl.Uniform1f(gl::uniform(gl, program_, "ahead_cosine"), kAheadCosine);
        gl.Uniform1f(gl::uniform(gl, program_, "grazing_cosine"), kGrazingCosine);
        const auto faces = faces_from_world();
        gl.UniformMatrix3fv(gl::uniform(gl, program_, "face_from_world"),
                            static_cast<GLsizei>(faces.size()), GL_FALSE, &faces[0][0][0]);
        groups_ = gl::uniform(gl, program_, "groups");
        first_eye_ = gl::uniform(gl, program_, "first_eye");
        weights_ = gl::make_buffer(gl, weights.data(), bytes_of(weights));
        GLint most = 0;
        gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
        most_bytes_ = most;
    });
}

RecordShader::~RecordShader() {
    context_.release("releasing the record shader", [&](const gl::Api& gl) {
        for (const GLuint buffer : {weights_, eyes_.name, records_.name})
            gl.DeleteBuffers(1, &buffer);
        gl.DeleteProgram(program_);
    });
}

std::optional<RecordShader::Solid> RecordShader::upload(const Surface& surface) {
    const TriangleClusters clusters = cluster_triangles(surface);
    if (bytes_of(clusters.triangles) > most_bytes_) return std::nullopt;
    Solid solid;
    context_.run("preparing a solid for the record shader", [&](const gl::Api& gl) {
        const auto buffer = [&](const auto& items) {
            return gl::make_buffer(gl, items.data(), bytes_of(items));
        };
        solid.triangles = buffer(clusters.triangles);
        solid.block_boxes = buffer(clusters.block_boxes);
        solid.group_boxes = buffer(clusters.group_boxes);
        solid.first_blocks = buffer(clusters.first_block);
        solid.normals = buffer(surface.triangle_normals);
    });
    solid.groups = static_cast<GLuint>(clusters.first_block.size() - 1);
    return solid;
}

void RecordShader::release(const Solid& solid) noexcept {
    context_.release("releasing a solid of the record shader", [&](const gl::Api& gl) {
        for (const GLuint buffer : {solid.triangles, solid.block_boxes, solid.group_boxes,
                                    solid.first_blocks, solid.normals})
            gl.DeleteBuffers(1, &buffer);
    });
}

// A dispatch a solid, none of which waits for another: the GPU works on all of them at once.
void RecordShader::look(std::span<const Job> jobs) {
    padded_eyes_.clear();
    for (const Job& job : jobs) {
        ZSKEL_ASSERT(job.eyes.size() == job.records.size(), "one record an eye");
        for (const Vec3& eye : job.eyes) padded_eyes_.emplace_back(eye, 0.0f);
    }
    if (padded_eyes_.empty()) return;
    context_.run("reducing cube maps", [&](const gl::Api& gl) {
        eyes_.fill(gl, padded_eyes_.data(), padded_eyes_.size() * sizeof(glm::vec4));
        records_.reserve(gl, padded_eyes_.size() * sizeof(EyeRecord));
        auto* record = reinterpret_cast<EyeRecord*>(records_.bytes);
        // A workgroup that is cut short may not even write that it was.
        for (std::size_t e = 0; e < padded_eyes_.size(); ++e) record[e].hit_fraction = kCutShort;
        gl.UseProgram(program_);
        std::size_t first = 0;
        for (const Job& job : jobs) {
            bind(gl, *job.solid);
            dispatch(gl, first, job.eyes.size());
            first += job.eyes.size();
        }
        gl::wait_for_writes(gl);
        for (const Job& job : jobs) {
            std::copy_n(record, job.records.size(), job.records.begin());
            record += job.records.size();
        }
    });
}

void RecordShader::bind(const gl::Api& gl, const Solid& solid) const {
    const GLuint buffers[] = {eyes_.name,        solid.triangles,    solid.block_boxes,
                              solid.group_boxes, solid.first_blocks, solid.normals,
                              weights_,          records_.name};
    GLuint binding = 0;
    for (const GLuint buffer : buffers)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, buffer);
    gl.Uniform1ui(groups_, solid.groups);
}

void RecordShader::dispatch(const gl::Api& gl, std::size_t first, std::size_t count) const {
    for (std::size_t done = 0; done < count; done += kMostGroups) {
        gl.Uniform1ui(first_eye_, static_cast<GLuint>(first + done));
        gl.DispatchCompute(static_cast<GLuint>(std::min(kMostGroups, count - done)), 1, 1);
    }
}

}  // namespace zskel
