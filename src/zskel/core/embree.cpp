#include "zskel/core/embree.h"

#include <fmt/format.h>

#include <new>

#include "zskel/core/error.h"

namespace zskel {

EmbreeDevice open_embree() {
    EmbreeDevice device(rtcNewDevice(nullptr));
    if (device != nullptr) return device;
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw Error(ExitCode::Backend,
                fmt::format("Embree gives no device (error {})", static_cast<int>(error)));
}

void build_hierarchy(RTCScene scene, RTCDevice device) {
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

}  // namespace zskel
