#include "zskel/core/embree.h"

#include <fmt/format.h>

#include <new>
#include <string_view>

#include "zskel/core/error.h"

namespace zskel {
namespace {

[[noreturn]] void fail(RTCError error, std::string_view what) {
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw Error(ExitCode::Backend,
                fmt::format("Embree {} (error {})", what, static_cast<int>(error)));
}

}  // namespace

EmbreeDevice open_embree() {
    EmbreeDevice device(rtcNewDevice(nullptr));
    if (device == nullptr) fail(rtcGetDeviceError(nullptr), "gives no device");
    return device;
}

RTCRay embree_ray(const Vec3& from, const Vec3& along, float farthest) {
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = along.x;
    ray.dir_y = along.y;
    ray.dir_z = along.z;
    ray.tfar = farthest;
    ray.mask = 0xFFFFFFFFu;
    return ray;
}

bool meets_nothing(RTCScene scene, RTCRay ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar >= 0.0f;  // Embree's sign of a hit is -inf
}

void build_hierarchy(RTCScene scene, RTCDevice device) {
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) fail(error, "builds no hierarchy");
}

}  // namespace zskel
