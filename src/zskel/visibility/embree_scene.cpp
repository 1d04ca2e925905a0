#include "zskel/visibility/embree_scene.h"

#include <cstring>
#include <new>

namespace zskel {

EmbreeScene::EmbreeScene(const Surface& surface, Shape shape)
    : device_(open_embree()), scene_(rtcNewScene(device_.get())) {
    const bool is_quick = shape == Shape::Quick;
    const auto shaped = is_quick ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE;
    const auto quality = is_quick ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
    rtcSetSceneFlags(scene_.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | shaped));
    rtcSetSceneBuildQuality(scene_.get(), quality);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes at the last vertex, so positions go through a padded buffer of its own.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vec3), surface.positions.size());
    if (vertices == nullptr) throw std::bad_alloc();
    std::memcpy(vertices, surface.positions.data(), surface.positions.size() * sizeof(Vec3));
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               surface.triangles.data(), 0, sizeof(Triangle),
                               surface.triangles.size());
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    build_hierarchy(scene_.get(), device_.get());
}

}  // namespace zskel
