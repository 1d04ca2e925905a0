#include "batch/shared_gpu.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "batch/gpu_address.h"
#include "batch/gpu_wire.h"
#include "zskel/core/assert.h"
#include "zskel/core/error.h"
#include "zskel/visibility/cube_map.h"

namespace zskel::batch {
namespace {

// The connection: one question after the other.
class Link {
  public:
    explicit Link(const std::string& address) : socket_(connect_to(address)) {}
    ~Link() { ::close(socket_); }
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    // Where that process has ended, all is forgotten.
    void forget(std::uint32_t solid) {
        send_message(socket_, static_cast<std::uint32_t>(Ask::Release), solid, {});
    }

    // Asks for so many bytes that `receive` is to take.
    void ask_for(std::size_t bytes, Ask what, std::uint32_t solid,
                 std::initializer_list<Bytes> parts) {
        if (ask(what, solid, parts) != bytes) throw GlError("the batch's GPU process errs");
    }

    // Asks, and learns how long the answer is.
    std::size_t ask(Ask what, std::uint32_t solid, std::initializer_list<Bytes> parts) {
        if (!send_message(socket_, static_cast<std::uint32_t>(what), solid, parts)) lost();
        Head head;
        receive(std::as_writable_bytes(std::span(&head, 1)));
        if (head.what == kWentWrong) throw GlError(receive_text(head.bytes));
        return head.bytes;
    }

    void receive(std::span<std::byte> bytes) {
        if (!receive_exactly(socket_, bytes)) lost();
    }

    std::string receive_text(std::size_t bytes) {
        std::string text(bytes, '\0');
        receive(std::as_writable_bytes(std::span(text)));
        return text;
    }

    // Nothing comes that was not asked for, but for the end.
    bool is_lost() const {
        pollfd end{socket_, POLLIN, 0};
        return ::poll(&end, 1, 0) != 0;
    }

  private:
    [[noreturn]] static void lost() { throw GpuProcessLost(); }

    int socket_;
};

class SharedSource : public VisibilitySource {
  public:
    SharedSource(const Surface& solid, int face_px, std::uint32_t number, Link& link)
        : VisibilitySource(solid, cube_directions(face_px)), number_(number), link_(link) {
        const std::array<std::uint64_t, 2> counts{solid.positions.size(), solid.triangles.size()};
        link_.ask_for(0, Ask::Prepare, number_,
                      {std::as_bytes(std::span(counts)), std::as_bytes(std::span(solid.positions)),
                       std::as_bytes(std::span(solid.triangles)),
                       std::as_bytes(std::span(solid.triangle_normals))});
    }

    ~SharedSource() override { link_.forget(number_); }
    SharedSource(const SharedSource&) = delete;
    SharedSource& operator=(const SharedSource&) = delete;

    void look(std::span<const Vec3> eyes, std::span<EyeRecord> records) override {
        ZSKEL_ASSERT(eyes.size() == records.size(), "one record an eye");
        if (eyes.empty()) return;
        link_.ask_for(records.size_bytes(), Ask::Look, number_, {std::as_bytes(eyes)});
        link_.receive(std::as_writable_bytes(records));
    }

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        maps.resize(eyes.size(), directions().size());
        const std::size_t bytes =
            std::span(maps.distance).size_bytes() + std::span(maps.id).size_bytes();
        link_.ask_for(bytes, Ask::Render, number_, {std::as_bytes(eyes)});
        link_.receive(std::as_writable_bytes(std::span(maps.distance)));
        link_.receive(std::as_writable_bytes(std::span(maps.id)));
    }

  private:
    std::uint32_t number_;
    Link& link_;
};

class SharedGpu : public Backend {
  public:
    SharedGpu(BackendInfo info, int face_px, std::unique_ptr<Link> link)
        : Backend(std::move(info)), face_px_(face_px), link_(std::move(link)) {}
    std::unique_ptr<VisibilitySource> prepare(const Surface& solid) override {
        return std::make_unique<SharedSource>(solid, face_px_, next_++, *link_);
    }

    bool is_lost() const { return link_->is_lost(); }

  private:
    int face_px_;
    std::unique_ptr<Link> link_;
    std::uint32_t next_ = 0;
};

}  // namespace

std::unique_ptr<Backend> open_shared_gpu(const std::string& address, int face_px,
                                         const std::string& reason) {
    auto link = std::make_unique<Link>(address);
    BackendInfo info = backend_info_of(link->receive_text(link->ask(Ask::Open, 0, {})));
    info.reason = reason;
    return std::make_unique<SharedGpu>(std::move(info), face_px, std::move(link));
}

bool has_lost_process(const Backend& backend) {
    const auto* shared = dynamic_cast<const SharedGpu*>(&backend);
    return shared != nullptr && shared->is_lost();
}

}  // namespace zskel::batch
