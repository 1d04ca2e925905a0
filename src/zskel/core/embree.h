#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "zskel/core/types.h"

namespace zskel {

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, EmbreeRelease>;
using EmbreeHierarchy = std::unique_ptr<RTCSceneTy, EmbreeRelease>;

/// A ray whose parameter runs from 0 to `farthest`, in lengths of `along`.
RTCRay embree_ray(const Vec3& from, const Vec3& along, float farthest);

/// Whether a ray meets no triangle.
bool meets_nothing(RTCScene scene, RTCRay ray);

/// @throws std::bad_alloc; Error with ExitCode::Backend for any other reason.
EmbreeDevice open_embree();

/// Builds the hierarchy over what is attached. @throws std::bad_alloc; Error with
/// ExitCode::Backend.
void build_hierarchy(RTCScene scene, RTCDevice device);

}  // namespace zskel
