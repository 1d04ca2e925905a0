#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>

#include "command.h"
#include "zskel/io/output_file.h"
#include "zskel/visibility/cube_map.h"

namespace zskel::cli {
namespace {

namespace fs = std::filesystem;

CLI::Validator number_check(const std::string& name, const std::string& expected,
                            const std::function<bool(double)>& is_fine) {
    return {[=](std::string& text) {
                double value = 0.0;
                const bool fine = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                                  is_fine(value);
                return fine ? std::string() : fmt::format("{} is not {}", text, expected);
            },
            name};
}

// A device or a pipe may be named twice and lies in no folder of ours.
bool is_file_to_be(const std::string& path) {
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    return path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
}

// The path without links and dots, whether it is there or not.
fs::path full_path(const std::string& path) {
    std::error_code unknown;
    return fs::weakly_canonical(fs::absolute(path, unknown), unknown);
}

void check_folder(const std::string& path) {
    const fs::path folder = full_path(path).parent_path();
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw IoError(
            fmt::format("{}: cannot write: {}: {}", path, folder.string(), std::strerror(errno)));
    }
}

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code unknown;
    return full_path(a) == full_path(b) || fs::equivalent(a, b, unknown);
}

}  // namespace

CLI::Validator positive_length() {
    return number_check("POSITIVE", "a number above 0", [](double value) { return value > 0.0; });
}

CLI::Validator length_or_zero() {
    return number_check("NONNEGATIVE", "a number from 0 up",
                        [](double value) { return value >= 0.0; });
}

CLI::Validator number_in(double low, double high) {
    return number_check(fmt::format("FLOAT in [{} - {}]", low, high),
                        fmt::format("a number from {} to {}", low, high),
                        [=](double value) { return value >= low && value <= high; });
}

void check_outputs(const std::string& model, const std::vector<std::string>& outputs) {
    std::vector<std::string> seen;
    if (std::ranges::count(outputs, "-") > 1) throw UsageError("two outputs go to standard output");
    for (const std::string& path : outputs) {
        std::error_code unknown;
        if (fs::is_directory(path, unknown)) throw IoError(fmt::format("{}: is a folder", path));
        if (path.empty() || !is_file_to_be(path)) continue;
        if (model != "-" && is_same_file(path, model))
            throw UsageError(fmt::format("{}: the output would replace the model", path));
        for (const std::string& other : seen) {
            if (is_same_file(path, other))
                throw UsageError(fmt::format("{}: two outputs go to this file", path));
        }
        check_folder(path);
        seen.push_back(path);
    }
}

void check_extension(const std::string& path, std::string_view extension) {
    if (!path.empty() && is_file_to_be(path) && !path.ends_with(extension))
        throw UsageError(fmt::format("{}: what is written there is a {} file", path, extension));
}

CLI::Option* add_model_argument(CLI::App& command, std::string& model) {
    return command
        .add_option(
            "model", model,
            "OBJ, OFF, PLY or STL; BPT or JSON: surfaces by formula; - reads standard input")
        ->required();
}

bool is_skeleton_json(const std::string& path) {
    return path.ends_with(".json") && !path.ends_with(".surface.json");
}

void add_backend_options(CLI::App& command, BackendOptions& options) {
    command
        .add_option_function<std::string>(
            "--backend",
            [&options](const std::string& name) { options.kind = parse_backend(name); },
            "auto: the CPU's Z-buffer or a GPU, by predicted time; cpu; gl: the first GL context "
            "that works; egl; osmesa; ray: Embree; brute: every ray against every triangle")
        ->type_name("NAME");
    command.add_option("--gpu", options.gpu, "Take the hardware device of this number")
        ->check(CLI::Range(0, 1 << 16));
    CLI::Option* face_px =
        command
            .add_option("--face-px", options.face_px,
                        "Texels along a cube face, 4 to 1024 (default 16; 10 for --method newton)")
            ->check(CLI::Range(kMinFacePx, kMaxFacePx));
    command.add_flag("--exact", options.exact,
                     "The CPU's Z-buffer: no coarser levels of solids of 100,000 faces and more");
    command
        .add_option("--rays", options.rays,
                    "Ray backends: this many directions an eye, spread evenly, in place of the "
                    "cube's texels "
                    "(the paper: 197)")
        ->check(CLI::Range(1, 1 << 20))
        ->excludes(face_px);
}

CLI::Option* add_view_option(CLI::App& command, PictureOptions& options) {
    return command
        .add_option_function<std::string>(
            "--view", [&options](const std::string& text) { options.view = parse_view(text); },
            "Where pictures are taken from: front, back, left, right, top, bottom, iso, or "
            "AZIMUTH,ELEVATION in degrees; with ,z at the end z is up")
        ->type_name("VIEW");
}

void add_picture_options(CLI::App& command, PictureOptions& options,
                         const std::vector<CLI::Option*>& pictures) {
    std::vector<CLI::Option*> details{add_view_option(command, options)};
    for (const auto& [name, px] : {std::pair{"--picture-width", &options.width_px},
                                   std::pair{"--picture-height", &options.height_px}}) {
        details.push_back(command.add_option(name, *px, "Pixels")
                              ->capture_default_str()
                              ->check(CLI::Range(16, 8192)));
    }
    command.parse_complete_callback([details, pictures] {
        const auto is_given = [](const CLI::Option* option) { return option->count() > 0; };
        const auto detail = std::ranges::find_if(details, is_given);
        if (detail != details.end() && std::ranges::none_of(pictures, is_given))
            throw CLI::RequiresError((*detail)->get_name(), pictures.front()->get_name());
    });
}

void print(const std::string& text) {
    write_output_text("-", text);
}

}  // namespace zskel::cli
