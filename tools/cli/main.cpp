// The command-line program: reads the line, sets up the log, runs one subcommand, maps errors to
// exit codes.
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string_view>

#include "batch_worker.h"
#include "command.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/io/output_file.h"

namespace zskel::cli {
namespace {

constexpr const char* kExitCodes = R"(Exit codes:
  0 fine   1 internal error   2 usage   3 bad input   4 no usable backend   5 cannot write   6 a check failed
  7 a limit reached   128 + N stopped by signal N)";

constexpr const char* kExamples = R"(Examples:
  zskel extract models/horse.obj -o horse.json --picture horse.png
  zskel convert horse.json -o horse.swc
  zskel rig horse.obj -o horse.glb
  zskel check scan.ply
  zskel batch scans/ -o 'out/{stem}.json'
  zskel doctor)";

void stop_cleanly(int signal) {
    remove_unfinished_files();
    ::_exit(128 + signal);
}

void stop_cleanly_on(int signal) {
    struct sigaction before {};
    // What a caller had ignored, as nohup does with SIGHUP, stays ignored.
    if (signal == SIGHUP && ::sigaction(signal, nullptr, &before) == 0 &&
        before.sa_handler == SIG_IGN)
        return;
    std::signal(signal, stop_cleanly);
}

void set_up(const Common& common) {
    const LogLevel level = common.verbosity < 0    ? LogLevel::Error
                           : common.verbosity == 0 ? LogLevel::Warning
                           : common.verbosity == 1 ? LogLevel::Info
                                                   : LogLevel::Debug;
    set_log(level, common.log_format == "json" ? LogFormat::Json : LogFormat::Text);
    set_thread_limit(common.threads);
    // The bounds of a whole batch are its parent's.
    if (!is_batch_worker()) set_limits(common.limits);
}

// Known before the line is read, so that an error in the line itself has the form asked for.
LogFormat log_format_of(int argc, char** argv) {
    LogFormat format = LogFormat::Text;
    for (int i = 1; i < argc; ++i) {
        std::string_view value = argv[i];
        if (value == "--log-format" && i + 1 < argc) {
            value = argv[i + 1];
        } else if (value.starts_with("--log-format=")) {
            value.remove_prefix(value.find('=') + 1);
        } else {
            continue;
        }
        format = value == "json" ? LogFormat::Json : LogFormat::Text;
    }
    return format;
}

std::string usage_text(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining(true);
    const auto chosen = app.get_subcommands();
    return fmt::format("{}; see zskel {}--help",
                       unknown.empty() ? error.what() : "unknown argument " + unknown.front(),
                       chosen.empty() ? "" : chosen.front()->get_name() + " ");
}

// False when the line asked for help or the version, which is then printed.
bool parse_line(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::ParseError& error) {
        std::ostringstream answer;
        std::ostringstream complaint;
        if (app.exit(error, answer, complaint) != 0) throw UsageError(usage_text(app, error));
        print(answer.str());
        return false;
    }
}

int fail(ExitCode code, const char* text) {
    log_line(LogLevel::Error, text);
    return static_cast<int>(code);
}

int run_program(int argc, char** argv) {
    CLI::App app("zskel: curve skeletons of triangle meshes from visible repulsive force", "zskel");
    app.set_version_flag("--version", std::string("zskel ") + ZSKEL_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    Common common;
    for (int i = 0; i < argc; ++i)
        common.command += (i == 0 ? "" : " ") + std::string(i == 0 ? "zskel" : argv[i]);
    CLI::Option* quiet = app.add_flag_function(
        "-q,--quiet", [&](std::int64_t) { common.verbosity = -1; }, "Only errors");
    app.add_flag_function(
           "-v,--verbose", [&](std::int64_t count) { common.verbosity = static_cast<int>(count); },
           "Say what is done; twice: say more")
        ->excludes(quiet);
    app.add_option("--log-format", common.log_format, "text, or json: one object a line")
        ->check(CLI::IsMember({"text", "json"}));
    app.add_option("--threads", common.threads, "Use at most this many threads")
        ->check(CLI::Range(0, 4096));
    app.add_option(
           "--chord-error", common.reading.chord_error,
           "Of surfaces by formula (.bpt, .json): how far their triangles may be from them, "
           "in diagonals of the bounding box")
        ->capture_default_str()
        ->check(positive_length());
    app.add_option("--max-faces", common.reading.max_faces,
                   "Refuse models of more triangles, with exit code 7; 0: no bound")
        ->capture_default_str()
        ->check(length_or_zero());
    add_limit_options(app, common.limits);
    Run run;
    add_batch_command(app, common, run);
    add_extract_command(app, common, run);
    add_convert_command(app, common, run);
    add_rig_command(app, common, run);
    add_deform_command(app, common, run);
    add_reconstruct_command(app, common, run);
    add_match_command(app, common, run);
    add_report_command(app, common, run);
    add_check_command(app, common, run);
    add_repair_command(app, common, run);
    add_depth_command(app, common, run);
    add_compare_command(app, common, run);
    add_doctor_command(app, common, run);
    app.footer(fmt::format("{}\n\n{}", kExitCodes, kExamples));
    for (CLI::App* command : app.get_subcommands({}))
        command->footer(fmt::format("{}\n\n{}", kExitCodes, command->get_footer()));
    set_log(LogLevel::Warning, log_format_of(argc, argv));
    try {
        if (!parse_line(app, argc, argv)) return static_cast<int>(ExitCode::Ok);
        set_up(common);
        return static_cast<int>(run());
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::Limit, "more memory is needed than there is, or --max-memory allows");
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
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) zskel::cli::stop_cleanly_on(signal);
    // A closed pipe and a file that may not grow are then errors of the write, with its exit code.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    return zskel::cli::run_program(argc, argv);
}
