#include "run_limits.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "command.h"
#include "zskel/core/error.h"
#include "zskel/core/log.h"
#include "zskel/io/output_file.h"

namespace zskel::cli {
namespace {

constexpr double kMegabyte = 1e6;

[[noreturn]] void end_after(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    remove_unfinished_files();
    log_line(LogLevel::Error, fmt::format("not done after {} s (--timeout)", seconds));
    ::_exit(static_cast<int>(ExitCode::Limit));
}

}  // namespace

void add_limit_options(CLI::App& app, Limits& limits) {
    app.add_option("--timeout", limits.timeout_s,
                   "Give up after so many seconds, with exit code 7 and no output; 0: never")
        ->capture_default_str()
        ->check(number_in(0.0, 1e8));
    app.add_option("--max-memory", limits.max_memory_mb,
                   "Give up, with exit code 7 and no output, when more than so many megabytes are "
                   "needed, of which any model takes about 200, reserved rather than used; 0: no "
                   "bound")
        ->capture_default_str()
        ->check(number_in(0.0, 1e9));
}

void set_limits(const Limits& limits) {
    if (limits.max_memory_mb > 0.0) {
        rlimit bound{};
        ::getrlimit(RLIMIT_DATA, &bound);
        bound.rlim_cur = static_cast<rlim_t>(limits.max_memory_mb * kMegabyte);
        if (::setrlimit(RLIMIT_DATA, &bound) != 0) {
            throw UsageError(
                fmt::format("--max-memory {}: {}", limits.max_memory_mb, std::strerror(errno)));
        }
    }
    if (limits.timeout_s > 0.0) std::thread(end_after, limits.timeout_s).detach();
}

}  // namespace zskel::cli
