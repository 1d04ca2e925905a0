// Linux: the death of the parent is told by PR_SET_PDEATHSIG.
#include "batch/child_process.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

// In the new process; its parent may have died before it asked to die with it.
void bind_to_parent(pid_t parent) {
    sigset_t stops;
    sigemptyset(&stops);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&stops, signal);
    ::sigprocmask(SIG_BLOCK, &stops, nullptr);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
}

}  // namespace

pid_t start_child(const std::function<void()>& work) {
    std::fflush(nullptr);
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
        bind_to_parent(parent);
        work();
        ::_exit(1);
    }
    if (child < 0)
        throw Error(ExitCode::Internal, fmt::format("no new process: {}", std::strerror(errno)));
    return child;
}

int reap(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

}  // namespace zskel::batch
