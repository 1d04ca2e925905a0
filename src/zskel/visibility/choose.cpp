#include "zskel/visibility/choose.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <system_error>

#include "zskel/visibility/cube_map.h"

namespace zskel {
namespace {

constexpr double kFaces = 2000.0;       // at which the costs are told
constexpr double kCpuSeconds = 22e-6;   // a map of 16 texels a face, one thread
constexpr double kCpuFixedShare = 0.4;  // of it, that does not grow with the texels
constexpr double kGpuSeconds = 0.5e-6;  // likewise, on an H200
constexpr double kGpuContextSeconds = 0.15;

// Both sources leave out what is hidden: costs grow with the square root of the faces (measured,
// 2k to 128k).
double size_factor(const Workload& work) {
    return std::sqrt(static_cast<double>(work.faces) / kFaces);
}

}  // namespace

bool has_gpu_device(const std::filesystem::path& dev) {
    constexpr std::array<std::string_view, 4> kFiles{"nvidiactl", "nvidia0", "dxg",
                                                     "dri/renderD128"};
    std::error_code error;
    for (const std::string_view file : kFiles) {
        if (std::filesystem::exists(dev / file, error)) return true;
    }
    return false;
}

double predicted_cpu_seconds(const Workload& work, int face_px, int threads) {
    const double texels = kCpuFixedShare + (1.0 - kCpuFixedShare) * face_px / 16.0;
    return kCpuSeconds * texels * size_factor(work) * static_cast<double>(work.evaluations) /
           threads;
}

double predicted_gpu_seconds(const Workload& work) {
    return kGpuContextSeconds * work.context_share +
           kGpuSeconds * size_factor(work) * static_cast<double>(work.evaluations);
}

Choice choose_source(const Workload& work, int face_px, int threads, bool has_gpu) {
    if (!has_gpu) return {false, "no GPU's device file is there"};
    if (face_px > kMostReducedFacePx)
        return {false, fmt::format("maps of {} texels are not reduced on a GPU", face_px)};
    if (work.evaluations == 0) return {false, "it is not known how much there is to do"};
    const double cpu = predicted_cpu_seconds(work, face_px, threads);
    const double gpu = predicted_gpu_seconds(work);
    return {gpu < cpu, fmt::format("predicted {:.2f} s on the CPU, {:.2f} s on a GPU", cpu, gpu)};
}

}  // namespace zskel
