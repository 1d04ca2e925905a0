#include "zskel/io/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "zskel/core/error.h"

namespace zskel {
namespace {

// Paths of the writes in progress, kept where a signal handler may read them: fixed slots of plain
// bytes.
constexpr std::size_t kSlots = 8;
constexpr std::size_t kMaxPath = 4096;
constexpr std::string_view kPartial = ".partial.";
struct Slot {
    std::atomic<bool> taken{false};
    std::atomic<bool> armed{false};
    std::array<char, kMaxPath> path{};
};
std::array<Slot, kSlots>& slots() {
    static std::array<Slot, kSlots> all;
    return all;
}

class Unfinished {
  public:
    explicit Unfinished(const std::string& path) {
        if (path.size() >= kMaxPath) throw IoError(fmt::format("{}: the path is too long", path));
        for (Slot& slot : slots()) {
            bool expected = false;
            if (!slot.taken.compare_exchange_strong(expected, true)) continue;
            std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
            slot.armed = true;
            slot_ = &slot;
            return;
        }
        throw IoError(
            fmt::format("{}: more than {} files are being written at once", path, kSlots));
    }
    ~Unfinished() {
        if (slot_->armed) std::remove(slot_->path.data());
        done();
        slot_->taken = false;
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;
    void done() { slot_->armed = false; }

  private:
    Slot* slot_ = nullptr;
};

[[noreturn]] void fail(const std::string& path) {
    throw IoError(fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
}

void write_all(std::FILE* file, std::string_view text, const std::string& path) {
    const std::size_t written = std::fwrite(text.data(), 1, text.size(), file);
    if (written != text.size() || std::fflush(file) != 0) fail(path);
}

}  // namespace

void write_output_file(const std::string& path,
                       const std::function<void(const std::string& temporary_path)>& write) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        if (std::filesystem::is_directory(status))
            throw IoError(fmt::format("{}: is a folder", path));
        write(path);  // a device or a pipe takes bytes as they come and must not be replaced
        return;
    }
    // A link stays one: what it points to is replaced.
    const std::filesystem::path target = std::filesystem::exists(status)
                                             ? std::filesystem::canonical(path)
                                             : std::filesystem::path(path);
    const std::string temporary = temporary_path(target, ::getpid()).string();
    Unfinished guard(temporary);
    write(temporary);
    if (std::rename(temporary.c_str(), target.c_str()) != 0) fail(path);
    guard.done();
}

void write_output_text(const std::string& path, std::string_view text) {
    if (path == "-") {
        write_all(stdout, text, "standard output");
        return;
    }
    write_output_file(path, [&](const std::string& temporary) {
        std::FILE* file = std::fopen(temporary.c_str(), "wb");
        if (file == nullptr) fail(path);
        try {
            write_all(file, text, path);
        } catch (...) {
            std::fclose(file);
            throw;
        }
        if (std::fclose(file) != 0) fail(path);
    });
}

// The extension stays at the end, for writers that choose their format by it.
std::filesystem::path temporary_path(const std::filesystem::path& target, int pid) {
    return target.parent_path() / fmt::format(".{}{}{}", pid, kPartial, target.filename().string());
}

std::optional<TemporaryFile> parse_temporary_name(const std::string& name) {
    const std::size_t at = name.find(kPartial);
    if (!name.starts_with('.') || at == std::string::npos) return std::nullopt;
    TemporaryFile found{0, name.substr(at + kPartial.size())};
    const char* const end = name.data() + at;
    const auto [stop, error] = std::from_chars(name.data() + 1, end, found.pid);
    if (error != std::errc() || stop != end || found.pid < 1 || found.target_name.empty())
        return std::nullopt;
    return found;
}

void remove_unfinished_files() noexcept {
    for (Slot& slot : slots()) {
        if (slot.armed) ::unlink(slot.path.data());
    }
}

}  // namespace zskel
