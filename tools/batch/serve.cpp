#include "batch/serve.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <span>
#include <string>

#include "batch/socket_io.h"
#include "batch/worker_pool.h"

namespace zskel::batch {
namespace {

constexpr double kMegabyte = 1e6;

void set_memory_bound(double memory_mb) {
    rlimit data{};
    if (memory_mb <= 0.0 || ::getrlimit(RLIMIT_DATA, &data) != 0) return;
    data.rlim_cur = std::min(data.rlim_cur, static_cast<rlim_t>(memory_mb * kMegabyte));
    ::setrlimit(RLIMIT_DATA, &data);
}

// False when the other end is closed.
bool receive(int socket, std::string& bytes) {
    std::array<char, 1 << 16> piece{};
    ssize_t count = 0;
    do {
        count = ::recv(socket, piece.data(), piece.size(), 0);
    } while (count < 0 && errno == EINTR);
    if (count <= 0) return false;
    bytes.append(piece.data(), static_cast<std::size_t>(count));
    return true;
}

void send(int socket, const std::string& text) {
    send_all(socket, std::as_bytes(std::span(text)));
}

}  // namespace

void serve(int socket, const Task& task, const std::string& gpu_address, double memory_mb) {
    ::prctl(PR_SET_NAME, "zskel-worker");
    set_memory_bound(memory_mb);
    SkeletonMaker maker(task, gpu_address);
    const auto begun = [socket](const Record& record) { send(socket, begun_line(record)); };
    std::string bytes;
    while (receive(socket, bytes)) {
        while (const std::optional<Request> request = take_request(bytes))
            send(socket, to_line(maker.make(*request, begun)) + "\n");
    }
}

}  // namespace zskel::batch
