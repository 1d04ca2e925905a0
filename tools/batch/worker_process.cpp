#include "batch/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

#include "batch/child_process.h"
#include "batch/stale_files.h"
#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

constexpr std::string_view kBegun = "BEGUN ";
constexpr int kMostStarts = 3;

std::string signal_text(int signal) {
    if (signal == SIGKILL)
        return "killed from outside, as the system does when memory runs out (signal 9)";
    return fmt::format("{} (signal {})", ::strsignal(signal), signal);
}

}  // namespace

std::string begun_line(const Record& record) {
    return fmt::format("{}{} {}\n", kBegun, record.key, record.backend);
}

void Worker::start() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw Error(ExitCode::Internal, fmt::format("no socket pair: {}", std::strerror(errno)));
    }
    try {
        pid_ = start_child([&] {
            ::close(ends[0]);
            launch_(ends[1]);
        });
    } catch (const Error&) {
        for (const int end : ends) ::close(end);
        throw;
    }
    ::close(ends[1]);
    socket_ = ends[0];
    ::fcntl(socket_, F_SETFL, O_NONBLOCK);
    received_.clear();
    items_done_ = 0;
}

// A request is smaller than a socket's buffer, which is empty then.
bool Worker::send(const std::string& message) {
    ssize_t sent = 0;
    do {
        sent = ::send(socket_, message.data(), message.size(), MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent == static_cast<ssize_t>(message.size());
}

void Worker::give(const Request& request, std::optional<Clock::duration> timeout) {
    timeout_ = timeout;
    is_second_try_ = false;
    hand(request);
}

void Worker::hand(const Request& request) {
    const std::string message = to_message(request);
    for (int attempt = 0; attempt < kMostStarts; ++attempt) {
        if (socket_ < 0) start();
        if (send(message)) {
            request_ = request;
            begun_ = {};
            start_ = Clock::now();
            deadline_.reset();
            if (timeout_) deadline_ = start_ + *timeout_;
            return;
        }
        stop();  // it died idle, which is no fault of this item
    }
    throw Error(ExitCode::Internal, "workers end as soon as they are started");
}

// False when the other end is closed.
bool Worker::read_socket() {
    std::array<char, 1 << 16> piece{};
    while (true) {
        const ssize_t count = ::recv(socket_, piece.data(), piece.size(), 0);
        if (count > 0) {
            received_.append(piece.data(), static_cast<std::size_t>(count));
        } else if (count == 0 || errno != EINTR) {
            return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
        }
    }
}

std::optional<Record> Worker::take_record() {
    std::size_t end = 0;
    while ((end = received_.find('\n')) != std::string::npos) {
        const std::string line = received_.substr(0, end);
        received_.erase(0, end + 1);
        if (line.starts_with(kBegun)) {
            const std::size_t space = line.find(' ', kBegun.size());
            begun_.key = line.substr(kBegun.size(), space - kBegun.size());
            begun_.backend = line.substr(std::min(space, line.size() - 1) + 1);
        } else if (std::optional<Record> record = parse_record(line)) {
            return record;
        }
    }
    return std::nullopt;
}

// The heap of a process that has done other items may be in pieces; a GL context may be lost by
// what others did with it; and SIGKILL is no doing of a model's, unless the system had to make
// room.
bool Worker::deserves_second_try(const Record& record) const {
    if (is_second_try_ || record.status != Status::Failed) return false;
    return (record.reason == "memory" && items_done_ > 1) || record.reason == "no_backend" ||
           (record.reason == "crashed" && record.exit_code == 128 + SIGKILL);
}

std::optional<Record> Worker::receive() {
    const bool is_open = read_socket();
    if (!is_busy()) {
        if (!is_open) stop();
        return std::nullopt;
    }
    Request request = *request_;
    std::optional<Record> record = take_record();
    if (!record && !is_open) record = crashed();
    if (!record) return std::nullopt;
    record->model = request.model;
    record->output = request.output;
    request_.reset();
    deadline_.reset();
    ++items_done_;
    const bool again = deserves_second_try(*record);
    if (!is_open || record->reason == "memory") stop();
    if (!again) return record;
    is_second_try_ = true;
    request.is_alone = record->reason == "no_backend";
    hand(request);
    return std::nullopt;
}

Record Worker::ended(const std::string& reason, int exit_code, std::string text) {
    Record record = begun_;
    record.status = Status::Failed;
    record.reason = reason;
    record.exit_code = exit_code;
    record.text = std::move(text);
    record.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    return record;
}

Record Worker::crashed() {
    ::kill(pid_, SIGKILL);  // should it have closed its socket and gone on
    const int status = reap(pid_);
    remove_stale_file(request_->output, pid_);
    pid_ = -1;
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        return ended("crashed", 128 + signal, "the worker was stopped: " + signal_text(signal));
    }
    const int code = WEXITSTATUS(status);
    return ended("crashed", code, fmt::format("the worker ended with exit code {}", code));
}

Record Worker::time_out(double seconds) {
    Record record = ended("timeout", static_cast<int>(ExitCode::Limit),
                          fmt::format("not done after {} s (--item-timeout)", seconds));
    record.model = request_->model;
    record.output = request_->output;
    stop();
    return record;
}

void Worker::stop() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        reap(pid_);
        if (request_) remove_stale_file(request_->output, pid_);
    }
    pid_ = -1;
    request_.reset();
    deadline_.reset();
}

}  // namespace zskel::batch
