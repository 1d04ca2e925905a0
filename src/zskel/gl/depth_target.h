#pragma once

#include <cstdint>
#include <span>

#include "zskel/gl/api.h"

namespace zskel::gl {

/// A layered target: 32F depth and an unsigned integer id per texel. Lives in the context it was
/// made in.
class DepthTarget {
  public:
    DepthTarget(const Api& gl, int px, int layers);
    void destroy(const Api& gl);

    /// Binds it and its viewport, and clears depth to 0 (reversed: infinitely far) and ids to all
    /// ones.
    void begin(const Api& gl) const;

    /// Reads the first `layers` layers, rows upward.
    void read(const Api& gl, int layers, std::span<float> depth, std::span<std::uint32_t> id) const;

    int layers() const { return layers_; }

  private:
    int px_;
    int layers_;
    GLuint depth_ = 0;
    GLuint id_ = 0;
    GLuint framebuffer_ = 0;
};

/// Reversed-Z with an infinite far plane: depth near/z in [0, 1], greater is nearer, nothing
/// culled.
void set_reversed_depth(const Api& gl);

}  // namespace zskel::gl
