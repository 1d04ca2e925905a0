#include "batch/gpu_server.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "batch/gpu_wire.h"
#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

constexpr timeval kPatience{3, 0};    // with a worker that takes no answer
constexpr std::size_t kSlice = 2048;  // eyes of one worker at a time, so that none waits for long
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36;
constexpr std::size_t kKeptBytes = std::size_t{1} << 20;  // of a buffer

struct ServedSolid {
    Surface surface;
    std::unique_ptr<VisibilitySource> source;
};

// A worker: what it has sent, its solids, and what it waits to see.
struct Client {
    explicit Client(int of_worker) : socket(of_worker) {
        ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
    }
    ~Client() { ::close(socket); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    int socket;
    bool is_gone = false;
    bool awaits = false;  // an answer
    std::vector<std::byte> received;
    std::map<std::uint32_t, ServedSolid> solids;
    VisibilitySource* looks_from = nullptr;  // with `eyes`, if there are any
    std::vector<Vec3> eyes;
    std::vector<EyeRecord> records;
    std::size_t looked = 0;  // of them, so far

    void answer(std::uint32_t what, std::initializer_list<Bytes> parts) {
        awaits = false;
        is_gone = !send_message(socket, what, 0, parts) || is_gone;
    }
};

template <typename T>
std::vector<T> items_in(Bytes bytes) {
    std::vector<T> items(bytes.size() / sizeof(T));
    std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
    return items;
}

// Takes items off the front.
template <typename T>
std::vector<T> take_items(Bytes& bytes, std::uint64_t count) {
    const std::size_t size = count * sizeof(T);
    std::vector<T> items = items_in<T>(bytes.first(size));
    bytes = bytes.subspan(size);
    return items;
}

Surface surface_in(Bytes bytes) {
    const auto counts = take_items<std::uint64_t>(bytes, 2);
    if (bytes.size() != counts[0] * sizeof(Vec3) + counts[1] * (sizeof(Triangle) + sizeof(Vec3)))
        throw Error(ExitCode::Internal, "a solid's message is not as long as it says");
    Surface surface;
    surface.positions = take_items<Vec3>(bytes, counts[0]);
    surface.triangles = take_items<Triangle>(bytes, counts[1]);
    surface.triangle_normals = take_items<Vec3>(bytes, counts[1]);
    return surface;
}

class GpuServer {
  public:
    GpuServer(int listening, const BackendOptions& options)
        : listening_(listening), options_(options) {}

    void run() {
        try {
            while (true) {
                wait();
                for (const auto& client : clients_) take_messages(*client);
                look();
                std::erase_if(clients_, [](const auto& client) { return client->is_gone; });
            }
        } catch (const GlError& error) {
            for (const auto& client : clients_)
                if (client->awaits) fail(*client, error.what());
        }
    }

  private:
    void wait() {
        std::vector<pollfd> watched{{listening_, POLLIN, 0}};
        for (const auto& client : clients_) watched.push_back({client->socket, POLLIN, 0});
        ::poll(watched.data(), watched.size(), has_eyes() ? 0 : -1);
        for (std::size_t i = 0; i < clients_.size(); ++i)
            if (watched[i + 1].revents != 0) read_socket(*clients_[i]);
        if (watched[0].revents != 0) accept();
    }

    // Of the same user: the address is no secret.
    void accept() {
        const int socket = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
        if (socket < 0) return;
        auto client = std::make_unique<Client>(socket);
        ucred peer{};
        socklen_t size = sizeof peer;
        const bool is_known = ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
        if (is_known && peer.uid == ::geteuid()) clients_.push_back(std::move(client));
    }

    static void read_socket(Client& client) {
        std::array<std::byte, 1 << 16> piece{};
        while (true) {
            const ssize_t count = ::recv(client.socket, piece.data(), piece.size(), MSG_DONTWAIT);
            if (count > 0) {
                client.received.insert(client.received.end(), piece.begin(), piece.begin() + count);
            } else if (count == 0 || errno != EINTR) {
                client.is_gone = count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
                return;
            }
        }
    }

    void take_messages(Client& client) {
        std::size_t at = 0;
        Head head;
        while (client.received.size() - at >= sizeof head) {
            std::memcpy(&head, client.received.data() + at, sizeof head);
            client.is_gone = client.is_gone || head.bytes > kMostBytes;
            if (client.is_gone) break;
            if (client.received.size() - at - sizeof head < head.bytes) break;
            serve(client, head, Bytes(client.received).subspan(at + sizeof head, head.bytes));
            at += sizeof head + head.bytes;
        }
        client.received.erase(client.received.begin(),
                              client.received.begin() + static_cast<std::ptrdiff_t>(at));
        if (client.received.empty() && client.received.capacity() > kKeptBytes)
            client.received = {};
    }

    // What is one worker's fault costs that one. A GL pass that failed is everybody's.
    void serve(Client& client, const Head& head, Bytes bytes) {
        try {
            act(client, head, bytes);
        } catch (const GlError&) {
            throw;
        } catch (const std::exception& error) {
            fail(client, error.what());
            client.is_gone = true;
        }
    }

    void act(Client& client, const Head& head, Bytes bytes) {
        client.awaits = true;
        switch (static_cast<Ask>(head.what)) {
            case Ask::Ping:
                return client.answer(head.what, {});
            case Ask::Open:
                return open(client);
            case Ask::Prepare:
                return prepare(client, head.solid, bytes);
            case Ask::Look:
                client.looks_from = client.solids.at(head.solid).source.get();
                client.eyes = items_in<Vec3>(bytes);
                client.records.resize(client.eyes.size());
                client.looked = 0;
                return;
            case Ask::Render:
                return render(client, head.solid, items_in<Vec3>(bytes));
            case Ask::Release:
                client.solids.erase(head.solid);
                client.awaits = false;
        }
    }

    // One that cannot be opened may be asked for again.
    void open(Client& client) {
        try {
            if (!backend_)
                backend_ = uses_gl(options_) ? open_backend(options_) : open_gpu(options_);
        } catch (const GlError& error) {
            return fail(client, error.what());
        }
        const std::string info = to_text(backend_->info());
        client.answer(static_cast<std::uint32_t>(Ask::Open), {std::as_bytes(std::span(info))});
    }

    void prepare(Client& client, std::uint32_t number, Bytes bytes) {
        if (!backend_) throw Error(ExitCode::Internal, "no backend has been asked for");
        ServedSolid& solid = client.solids[number];
        solid.surface = surface_in(bytes);
        solid.source = backend_->prepare(solid.surface);
        client.answer(static_cast<std::uint32_t>(Ask::Prepare), {});
    }

    bool has_eyes() const {
        return std::any_of(clients_.begin(), clients_.end(), [](const auto& client) {
            return !client->is_gone && !client->eyes.empty();
        });
    }

    // A slice of what each who waits wants to see.
    void look() {
        std::vector<Look> looks;
        std::vector<Client*> looking;
        for (const auto& client : clients_) {
            if (client->is_gone || client->eyes.empty()) continue;
            const std::size_t count = std::min(kSlice, client->eyes.size() - client->looked);
            looks.push_back({client->looks_from,
                             std::span(client->eyes).subspan(client->looked, count),
                             std::span(client->records).subspan(client->looked, count)});
            looking.push_back(client.get());
            client->looked += count;
        }
        if (looks.empty()) return;
        backend_->look(looks);
        for (Client* client : looking) {
            if (client->looked < client->eyes.size()) continue;
            client->eyes.clear();
            client->answer(static_cast<std::uint32_t>(Ask::Look),
                           {std::as_bytes(std::span(client->records))});
        }
    }

    static void render(Client& client, std::uint32_t number, const std::vector<Vec3>& eyes) {
        MapBatch maps;
        client.solids.at(number).source->render(eyes, maps);
        client.answer(static_cast<std::uint32_t>(Ask::Render),
                      {std::as_bytes(std::span(maps.distance)), std::as_bytes(std::span(maps.id))});
    }

    static void fail(Client& client, const std::string& text) {
        client.answer(kWentWrong, {std::as_bytes(std::span(text))});
    }

    int listening_;
    BackendOptions options_;
    std::unique_ptr<Backend> backend_;
    std::vector<std::unique_ptr<Client>> clients_;
};

}  // namespace

void serve_gpu(int listening, const BackendOptions& options) {
    ::prctl(PR_SET_NAME, "zskel-gpu");
    GpuServer(listening, options).run();
}

}  // namespace zskel::batch
