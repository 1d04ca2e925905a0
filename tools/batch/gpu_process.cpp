#include "batch/gpu_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <utility>

#include "batch/child_process.h"
#include "batch/gpu_address.h"
#include "batch/gpu_wire.h"
#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

constexpr int kPatienceMs = 5000;

}  // namespace

GpuProcess::GpuProcess(std::function<void(int)> launch)
    : launch_(std::move(launch)),
      address_(fmt::format("zskel-{}-{:08x}", ::getpid(), std::random_device()())),
      listening_(listen_at(address_)) {
    start();
}

GpuProcess::~GpuProcess() {
    stop();
    ::close(listening_);
}

void GpuProcess::start() {
    pid_ = start_child([this] { launch_(listening_); });
}

void GpuProcess::stop() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    reap(std::exchange(pid_, -1));
}

void GpuProcess::tend() {
    if (::waitpid(pid_, nullptr, WNOHANG) == 0) return;
    pid_ = -1;
    start();
}

bool GpuProcess::answers() const {
    int socket = -1;
    try {
        socket = connect_to(address_);
    } catch (const GlError&) {
        return false;
    }
    const bool has_asked = send_message(socket, static_cast<std::uint32_t>(Ask::Ping), 0, {});
    pollfd answer{socket, POLLIN, 0};
    const bool has_answer = has_asked && ::poll(&answer, 1, kPatienceMs) > 0;
    ::close(socket);
    return has_answer;
}

void GpuProcess::replace_if_hung() {
    if (answers()) return;
    stop();
    start();
}

}  // namespace zskel::batch
