#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "zskel/extract.h"

namespace zskel::cli {

/// How skeletons are extracted, for the commands that leave all of it to the user.
struct ExtractionOptions {
    ExtractOptions extract;
    BackendOptions backend;
    std::vector<CLI::Option*> newton_only;  ///< refused with the other method
    std::vector<CLI::Option*> paper_only;
};

inline constexpr const char* kNewtonGroup = "Method newton";
inline constexpr const char* kPaperGroup = "Method paper";

/// Adds --method, what each method takes, and where visibility comes from. The options must outlive
/// the command.
void add_extraction_options(CLI::App& command, ExtractionOptions& options);

/// Adds --no-repair, --weld-tolerance, --no-caps, --join and --join-voxel.
void add_repair_options(CLI::App& command, ExtractOptions& options);

/// @throws UsageError when an option was given that the chosen method does not have.
void check_method_options(const ExtractionOptions& options);

}  // namespace zskel::cli
