// Linux: names of sockets that are no files.
#include "batch/gpu_address.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "zskel/core/assert.h"
#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

constexpr int kBacklog = 1024;  // workers

struct Name {
    sockaddr_un address{};
    socklen_t size = 0;
};

Name name_of(const std::string& address) {
    Name name;
    ZSKEL_ASSERT(address.size() + 1 < sizeof name.address.sun_path, "the name fits");
    name.address.sun_family = AF_UNIX;
    std::copy(address.begin(), address.end(), name.address.sun_path + 1);
    name.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + address.size());
    return name;
}

}  // namespace

int listen_at(const std::string& address) {
    const Name name = name_of(address);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const auto* at = reinterpret_cast<const sockaddr*>(&name.address);
    if (socket < 0 || ::bind(socket, at, name.size) != 0 || ::listen(socket, kBacklog) != 0) {
        const int error = errno;
        if (socket >= 0) ::close(socket);
        throw Error(ExitCode::Internal,
                    fmt::format("no socket to listen: {}", std::strerror(error)));
    }
    return socket;
}

int connect_to(const std::string& address) {
    const Name name = name_of(address);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0 ||
        ::connect(socket, reinterpret_cast<const sockaddr*>(&name.address), name.size) != 0) {
        const int error = errno;
        if (socket >= 0) ::close(socket);
        throw GlError(fmt::format("the batch's GPU process: {}", std::strerror(error)));
    }
    return socket;
}

}  // namespace zskel::batch
