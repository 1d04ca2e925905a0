#include "zskel/core/input_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

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

std::string read_input_file(const std::string& path, std::string_view expected) {
    const bool standard_input = path == "-";
    const std::unique_ptr<std::FILE, CloseFile> file(
        standard_input ? stdin : std::fopen(path.c_str(), "rb"));
    if (!file) fail_reading(path, errno, expected);
    std::string bytes(standard_input ? kFirstRead : first_read_size(path), '\0');
    std::size_t filled = 0;
    while (true) {
        filled += std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get());
        if (filled < bytes.size()) break;
        bytes.resize(bytes.size() * 2);
    }
    if (std::ferror(file.get()) != 0) fail_reading(path, errno, expected);
    bytes.resize(filled);
    return bytes;
}

}  // namespace zskel
