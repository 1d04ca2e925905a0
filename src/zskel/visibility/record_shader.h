#pragma once

#include <optional>
#include <span>
#include <vector>

#include "zskel/gl/api.h"
#include "zskel/gl/context.h"
#include "zskel/gl/mapped_buffer.h"
#include "zskel/gl/stream_buffer.h"
#include "zskel/mesh/surface.h"
#include "zskel/visibility/force.h"

namespace zskel {

/// The compute shader of one context that draws an eye's cube map where no map has to leave the
/// GPU: 16 bytes an eye go there, 52 come back, and all eyes of a call go at once.
class RecordShader {
  public:
    /// A solid's triangles in the context's memory.
    struct Solid {
        GLuint triangles = 0;
        GLuint block_boxes = 0;
        GLuint group_boxes = 0;
        GLuint first_blocks = 0;
        GLuint normals = 0;
        GLuint groups = 0;
    };

    /// @param face_px  at most kMostReducedFacePx.
    /// @throws GlError with the driver's log.
    RecordShader(int face_px, gl::Context& context);
    ~RecordShader();
    RecordShader(const RecordShader&) = delete;
    RecordShader& operator=(const RecordShader&) = delete;

    /// Nothing when the driver has no room for so large a solid. @throws GlError.
    std::optional<Solid> upload(const Surface& surface);
    void release(const Solid& solid) noexcept;

    /// A solid's eyes and where their records go: as many.
    struct Job {
        const Solid* solid = nullptr;
        std::span<const Vec3> eyes;
        std::span<EyeRecord> records;
    };

    /// Every eye's record, of all jobs in one go. One whose work the driver cut short, as software
    /// drivers do with long loops, has hit_fraction -1 and nothing else of meaning. @throws
    /// GlError.
    void look(std::span<const Job> jobs);

  private:
    void bind(const gl::Api& gl, const Solid& solid) const;
    void dispatch(const gl::Api& gl, std::size_t first, std::size_t count) const;

    gl::Context& context_;
    GLuint program_ = 0;
    GLint groups_ = -1;     // uniform
    GLint first_eye_ = -1;  // likewise
    GLuint weights_ = 0;
    GLsizeiptr most_bytes_ = 0;  // of one buffer
    gl::StreamBuffer eyes_;
    gl::MappedBuffer records_;
    std::vector<glm::vec4> padded_eyes_;
};

}  // namespace zskel
