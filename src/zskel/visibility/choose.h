#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace zskel {

/// What a backend is to do; zeros where nothing is known yet.
struct Workload {
    std::size_t faces = 0;
    std::size_t evaluations = 0;  ///< cube maps
    double context_share = 1.0;   ///< of a GPU context's making: less where others use it too
};

/// Whether a GPU's device file is there: no library is loaded and nothing opened to find out.
/// @param dev  the folder of device files.
bool has_gpu_device(const std::filesystem::path& dev = "/dev");

/// Predicted seconds for the evaluations, from what tools/bench measured.
/// @param face_px  texels along a cube face.
double predicted_cpu_seconds(const Workload& work, int face_px, int threads);

/// The same on a GPU, with the context and the shader that have to be made first: 0.15 s once the
/// driver keeps the shader compiled, as it does from the first run on a machine, which takes 2 s.
double predicted_gpu_seconds(const Workload& work);

struct Choice {
    bool is_gpu = false;
    std::string reason;  ///< for the log and the output
};

/// The source with the least predicted time.
Choice choose_source(const Workload& work, int face_px, int threads, bool has_gpu);

}  // namespace zskel
