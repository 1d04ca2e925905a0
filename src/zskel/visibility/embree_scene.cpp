#include "zskel/visibility/embree_scene.h"

#include <fmt/format.h>

#include <cstring>

#include "zskel/core/error.h"

namespace zskel {

EmbreeScene::EmbreeScene(const Surface& surface, Shape shape) : device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) {
        throw Error(ExitCode::Backend, fmt::format("Embree gives no device (error {})",
                                                   static_cast<int>(rtcGetDeviceError(nullptr))));
    }
    scene_ = rtcNewScene(device_);
    const auto shaped = shape == Shape::Compact ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE;
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | shaped));
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes at the last vertex, so positions go through a padded buffer of its own.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vec3), surface.positions.size());
    if (vertices == nullptr) throw std::bad_alloc();
    std::memcpy(vertices, surface.positions.data(), surface.positions.size() * sizeof(Vec3));
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               surface.triangles.data(), 0, sizeof(Triangle),
                               surface.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

}  // namespace zskel
