#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "zskel/io/skeleton_formats.h"

namespace zskel::cli {

/// Where a skeleton goes, and in which form.
struct SkeletonOutput {
    std::string path = "-";
    std::string format;
    bool node_link = false;
    bool tubes = false;
};

/// Adds -o, --format, --node-link and --tubes to a subcommand.
void add_output_options(CLI::App& command, SkeletonOutput& output);

/// The form that the options and the path's extension ask for.
/// @throws UsageError when they name none, or do not go together.
SkeletonFormat format_of(const SkeletonOutput& output);

}  // namespace zskel::cli
