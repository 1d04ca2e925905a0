#include "zskel/core/input_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "zskel/core/error.h"

namespace zskel {
namespace {

constexpr std::size_t kFirstRead = std::size_t{1} << 16;

struct CloseFile {
    void operator()(std::FILE* file) const {
        if (file != stdin) std::fclose(file);
    }
};

[[noreturn]] void fail_reading(const std::string& path, int error, std::string_view expected) {
    throw InputError(
        fmt::format("{}: cannot be read: {}; expected {}", path, std::strerror(error), expected));
}

/// How much to ask for at first: the whole of a regular file and one byte, to see its end.
std::size_t first_read_size(const std::string& path) {
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    return unknown ? kFirstRead : static_cast<std::size_t>(size) + 1;
}

}  // namespace

FileBytes read_input_file(const std::string& path, std::string_view expected) {
    const bool standard_input = path == "-";
    const std::unique_ptr<std::FILE, CloseFile> file(
        standard_input ? stdin : std::fopen(path.c_str(), "rb"));
    if (!file) fail_reading(path, errno, expected);
    std::size_t room = standard_input ? kFirstRead : first_read_size(path);
    FileBytes bytes{std::make_unique_for_overwrite<char[]>(room)};
    while (true) {
        bytes.size += std::fread(bytes.data.get() + bytes.size, 1, room - bytes.size, file.get());
        if (bytes.size < room) break;
        room *= 2;
        auto larger = std::make_unique_for_overwrite<char[]>(room);
        std::memcpy(larger.get(), bytes.data.get(), bytes.size);
        bytes.data = std::move(larger);
    }
    if (std::ferror(file.get()) != 0) fail_reading(path, errno, expected);
    return bytes;
}

}  // namespace zskel
