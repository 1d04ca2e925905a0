#include "depth_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "zskel/core/log.h"
#include "zskel/io/png.h"
#include "zskel/io/range_image.h"

namespace zskel::cli {
namespace {

constexpr std::size_t kDefaultTrajectories = 8;

std::vector<std::uint32_t> spread_vertices(const Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const Triangle& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (used[v]) all.push_back(v);
    }
    std::vector<std::uint32_t> some;
    const std::size_t count = std::min(kDefaultTrajectories, all.size());
    for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
    return some;
}

}  // namespace

void write_depth_file(const std::string& path, const DepthDump& dump) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".exr") {
        write_depth_exr(path, dump);
    } else if (extension == ".png") {
        const Image image = range_image(dump.face_px, dump.distance, dump.force.vector);
        write_png(path, image, fmt::format("zskel: {}, step {}", dump.model, dump.step));
    } else {
        throw UsageError(fmt::format("{}: a depth map is written as .exr or .png", path));
    }
}

void write_trajectories(const std::string& folder, std::vector<std::uint32_t> vertices,
                        const Mesh& mesh, const ExtractOptions& options, Backend& backend) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw IoError(fmt::format("{}: cannot make the folder: {}", folder, error.message()));
    if (vertices.empty()) vertices = spread_vertices(mesh);
    DepthProbe probe(mesh, backend);
    std::size_t files = 0;
    for (const std::uint32_t vertex : vertices) {
        for (const DepthDump& dump : probe.along_path(vertex, options)) {
            write_depth_exr(
                fmt::format("{}/vertex-{:06}-step-{:04}.exr", folder, vertex, dump.step), dump);
            ++files;
        }
    }
    log_info("{} depth maps of {} seeds in {}", files, vertices.size(), folder);
}

}  // namespace zskel::cli
