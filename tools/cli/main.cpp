// The command-line program: reads the line, sets up the log, runs one subcommand, maps errors to
// exit codes.
#include <malloc.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "command.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/io/output_file.h"

namespace zskel::cli {
namespace {

constexpr const char* kFooter = R"(Exit codes:
  0 fine   1 internal error   2 usage   3 bad input   4 no usable backend   5 cannot write   6 a check failed

Examples:
  zskel extract models/horse.obj -o horse.json --picture horse.png
  zskel check scan.ply
  zskel doctor)";

void stop_cleanly(int signal) {
    remove_unfinished_files();
    ::_exit(128 + signal);
}

void set_up(const Common& common) {
    const LogLevel level = common.verbosity < 0    ? LogLevel::Error
                           : common.verbosity == 0 ? LogLevel::Warning
                           : common.verbosity == 1 ? LogLevel::Info
                                                   : LogLevel::Debug;
    set_log(level, common.log_format == "json" ? LogFormat::Json : LogFormat::Text);
    set_thread_limit(common.threads);
}

int fail(ExitCode code, const char* text) {
    log_line(LogLevel::Error, text);
    return static_cast<int>(code);
}

int run_program(int argc, char** argv) {
    CLI::App app("zskel: curve skeletons of triangle meshes from visible repulsive force", "zskel");
    app.set_version_flag("--version", std::string("zskel ") + ZSKEL_VERSION);
    app.require_subcommand(1);
    app.footer(kFooter);
    app.fallthrough();
    Common common;
    for (int i = 0; i < argc; ++i)
        common.command += (i == 0 ? "" : " ") + std::string(i == 0 ? "zskel" : argv[i]);
    app.add_flag_function(
        "-q,--quiet", [&](std::int64_t) { common.verbosity = -1; }, "Only errors");
    app.add_flag_function(
        "-v,--verbose", [&](std::int64_t count) { common.verbosity = static_cast<int>(count); },
        "Say what is done; twice: say more");
    app.add_option("--log-format", common.log_format, "text, or json: one object a line")
        ->check(CLI::IsMember({"text", "json"}));
    app.add_option("--threads", common.threads, "Use at most this many threads")
        ->check(CLI::NonNegativeNumber);
    Run run;
    add_extract_command(app, common, run);

    add_check_command(app, common, run);
    add_depth_command(app, common, run);
    add_compare_command(app, common, run);
    add_doctor_command(app, common, run);
    try {
        app.parse(argc, argv);
        set_up(common);
        return static_cast<int>(run());
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::Internal, "out of memory");
    } catch (const std::exception& error) {
        return fail(ExitCode::Internal, error.what());
    }
}

}  // namespace
}  // namespace zskel::cli

int main(int argc, char** argv) {
    // Software GL drivers map and unmap their buffers at every draw unless the heap keeps them.
    ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
    ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
    std::signal(SIGINT, zskel::cli::stop_cleanly);
    std::signal(SIGTERM, zskel::cli::stop_cleanly);
    std::signal(SIGPIPE,
                SIG_IGN);  // a closed pipe is then an error of the write, with its exit code
    return zskel::cli::run_program(argc, argv);
}
