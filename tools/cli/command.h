#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "run_limits.h"
#include "zskel/core/error.h"
#include "zskel/io/picture.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/visibility/backend.h"

namespace zskel::cli {

/// What every subcommand can read: the options before it.
struct Common {
    int verbosity = 0;  ///< -q: -1; -v: 1; -vv: 2
    std::string log_format = "text";
    int threads = 0;
    ReadOptions reading;
    Limits limits;
    std::string command;  ///< the whole line as typed
};

/// Each adds its subcommand to the program; when that is chosen, `run` is set to what it does.
using Run = std::function<ExitCode()>;
void add_batch_command(CLI::App& app, const Common& common, Run& run);
void add_check_command(CLI::App& app, const Common& common, Run& run);
void add_compare_command(CLI::App& app, const Common& common, Run& run);
void add_convert_command(CLI::App& app, const Common& common, Run& run);
void add_deform_command(CLI::App& app, const Common& common, Run& run);
void add_depth_command(CLI::App& app, const Common& common, Run& run);
void add_doctor_command(CLI::App& app, const Common& common, Run& run);
void add_extract_command(CLI::App& app, const Common& common, Run& run);
void add_match_command(CLI::App& app, const Common& common, Run& run);
void add_reconstruct_command(CLI::App& app, const Common& common, Run& run);
void add_repair_command(CLI::App& app, const Common& common, Run& run);
void add_report_command(CLI::App& app, const Common& common, Run& run);
void add_rig_command(CLI::App& app, const Common& common, Run& run);

/// Adds the model, which is needed, as the subcommand's next argument.
CLI::Option* add_model_argument(CLI::App& command, std::string& model);

/// Whether a file is a skeleton as JSON by its name; NAME.surface.json is a surface by formula.
bool is_skeleton_json(const std::string& path);

/// Adds --backend, --gpu, --face-px and --rays to a subcommand.
void add_backend_options(CLI::App& command, BackendOptions& options);

/// Adds --view to a subcommand.
CLI::Option* add_view_option(CLI::App& command, PictureOptions& options);

/// Adds --view, --picture-width and --picture-height to a subcommand.
/// @param pictures  the options that draw one: without any of them the others are refused.
void add_picture_options(CLI::App& command, PictureOptions& options,
                         const std::vector<CLI::Option*>& pictures);

/// Checks for lengths: finite, and above 0 or not below it.
CLI::Validator positive_length();
CLI::Validator length_or_zero();
/// Unlike CLI::Range refuses what is no number.
CLI::Validator number_in(double low, double high);

/// Refuses outputs that cannot be meant, before any work is done. Empty names are left out.
/// @throws UsageError when an output is the model or another output; IoError when it is a folder,
/// or the folder that it goes to is not there or cannot be written to.
void check_outputs(const std::string& model, const std::vector<std::string>& outputs);

/// Refuses a file of another kind by its name. Standard output and devices take anything.
/// @throws UsageError
void check_extension(const std::string& path, std::string_view extension);

/// Prints text to standard output. @throws IoError when that is closed or full.
void print(const std::string& text);

}  // namespace zskel::cli
