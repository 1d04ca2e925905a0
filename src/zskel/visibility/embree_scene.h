#pragma once

#include <embree3/rtcore.h>

#include "zskel/mesh/surface.h"

namespace zskel {

/// An Embree scene over a surface's triangles (not copied; the surface must outlive it). Private to
/// the ray source and `SurfaceQuery`; robust mode, so that no ray slips through a shared edge.
class EmbreeScene {
  public:
    explicit EmbreeScene(const Surface& surface);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene get() const { return scene_; }

  private:
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace zskel
