#include "batch/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "zskel/core/error.h"
#include "zskel/core/log.h"

namespace zskel::batch {
namespace {

constexpr std::string_view kRecordBegin = "{\"model\":";

[[noreturn]] void fail(const std::string& path, const char* what) {
    throw IoError(fmt::format("{}: the journal {}: {}", path, what, std::strerror(errno)));
}

// An output as it reads in a journal: names may hold bytes that JSON cannot.
std::string readable(const std::string& output) {
    using Json = nlohmann::json;
    return Json(output).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Journal::Journal(const std::string& path, int file) : path_(path), file_(file) {
    if (file_ < 0) fail(path_, "cannot be opened");
}

// Whole once it has delegated: the file is closed when what follows throws.
Journal::Journal(const std::string& path)
    : Journal(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    lock();
    read();
}

Journal::~Journal() {
    ::close(file_);
}

// A record lock is the process's own: it ends with it however that ends, and children have none.
void Journal::lock() {
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    if (::fcntl(file_, F_SETLK, &whole) == 0) return;
    if (errno == EACCES || errno == EAGAIN) {
        throw UsageError(fmt::format(
            "{}: another batch is writing this journal; give each its own by --journal", path_));
    }
    // Some shared file systems have no locks at all.
    if (errno != ENOLCK && errno != ENOSYS && errno != EOPNOTSUPP) fail(path_, "cannot be locked");
    log_warning("{}: this file system has no locks: see that no other batch has this journal",
                path_);
}

void Journal::read() {
    struct stat status {};
    if (::fstat(file_, &status) != 0) fail(path_, "cannot be read");
    if (!S_ISREG(status.st_mode)) {
        throw UsageError(fmt::format("{}: a journal must be a file", path_));
    }
    std::string text;
    std::array<char, 1 << 16> piece{};
    while (true) {
        const ssize_t count =
            ::pread(file_, piece.data(), piece.size(), static_cast<off_t>(text.size()));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(path_, "cannot be read");
        if (count == 0) break;
        text.append(piece.data(), static_cast<std::size_t>(count));
    }
    take_lines(text);
    // Half a first record may be all that a killed batch left.
    const std::string_view begin = std::string_view(text).substr(0, kRecordBegin.size());
    if (last_.empty() && (strange_lines_ > 0 || !kRecordBegin.starts_with(begin)))
        throw UsageError(fmt::format("{}: is no journal of a batch, and is left as it is", path_));
    if (size_ < text.size() && ::ftruncate(file_, static_cast<off_t>(size_)) != 0)
        fail(path_, "cannot be cut after its last whole line");
}

void Journal::take_lines(const std::string& text) {
    std::size_t end = 0;
    while ((end = text.find('\n', size_)) != std::string::npos) {
        const std::string_view line(text.data() + size_, end - size_);
        size_ = end + 1;
        std::optional<Record> record = parse_record(line);
        if (record) {
            std::string output = readable(record->output);
            last_.insert_or_assign(std::move(output), std::move(*record));
        } else {
            ++strange_lines_;
        }
    }
}

const Record* Journal::find(const std::string& output) const {
    const auto found = last_.find(readable(output));
    return found == last_.end() ? nullptr : &found->second;
}

void Journal::append(const Record& record) {
    const std::string line = to_line(record) + "\n";
    ssize_t written = 0;
    do {
        written = ::write(file_, line.data(), line.size());
    } while (written < 0 && errno == EINTR);
    if (written != static_cast<ssize_t>(line.size())) {
        const int error = written < 0 ? errno : ENOSPC;
        if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) fail(path_, "has half a line now");
        errno = error;
        fail(path_, "cannot be written");
    }
    size_ += line.size();
    last_.insert_or_assign(readable(record.output), record);
}

void Journal::flush() {
    if (::fdatasync(file_) != 0 && errno != EINVAL) fail(path_, "cannot be written");
}

}  // namespace zskel::batch
