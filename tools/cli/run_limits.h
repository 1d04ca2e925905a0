#pragma once

#include <CLI/CLI.hpp>

namespace zskel::cli {

/// What a run may take at most; 0: no bound.
struct Limits {
    double timeout_s = 0.0;
    double max_memory_mb = 0.0;
};

/// Adds --timeout and --max-memory.
void add_limit_options(CLI::App& app, Limits& limits);

/// From now on. Past its time the program removes unfinished files and ends with
/// `ExitCode::Limit`; memory past the bound is refused (`std::bad_alloc`).
/// @throws UsageError when the system does not allow the bound.
void set_limits(const Limits& limits);

}  // namespace zskel::cli
