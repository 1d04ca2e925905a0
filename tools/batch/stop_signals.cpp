#include "batch/stop_signals.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

// What a handler may touch.
std::atomic<int> the_first{0};
std::atomic<int> the_count{0};
std::array<int, 2> the_pipe{-1, -1};

void note(int signal) {
    const int before = errno;
    int none = 0;
    the_first.compare_exchange_strong(none, signal);
    ++the_count;
    // A pipe that is full wakes just as well.
    [[maybe_unused]] const ssize_t written = ::write(the_pipe[1], "!", 1);
    errno = before;
}

}  // namespace

StopSignals::StopSignals() {
    if (::pipe2(the_pipe.data(), O_CLOEXEC | O_NONBLOCK) != 0)
        throw Error(ExitCode::Internal, fmt::format("no pipe: {}", std::strerror(errno)));
    the_first = 0;
    the_count = 0;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        struct sigaction action {};
        action.sa_handler = note;
        ::sigaction(kSignals[i], nullptr, &before_[i]);
        // What a caller had ignored, as nohup does with SIGHUP, stays ignored.
        if (before_[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
    }
}

StopSignals::~StopSignals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i)
        ::sigaction(kSignals[i], &before_[i], nullptr);
    for (int& end : the_pipe) {
        ::close(end);
        end = -1;
    }
}

int StopSignals::first() const {
    return the_first;
}

int StopSignals::count() const {
    return the_count;
}

int StopSignals::wake_fd() const {
    return the_pipe[0];
}

void StopSignals::forget_wake() {
    std::array<char, 64> bytes{};
    while (::read(the_pipe[0], bytes.data(), bytes.size()) > 0) {
    }
}

}  // namespace zskel::batch
