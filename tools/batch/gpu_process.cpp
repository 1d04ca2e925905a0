#include "batch/gpu_process.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <utility>

#include "batch/child_process.h"
#include "batch/gpu_address.h"

namespace zskel::batch {

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

void GpuProcess::replace() {
    stop();
    start();
}

}  // namespace zskel::batch
