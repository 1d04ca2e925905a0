#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace zskel {

/// Writes a file whole or not at all (devices and pipes get the bytes directly): `write` fills a
/// temporary file beside it, which is then renamed. The temporary file goes away when anything
/// fails and when the program is interrupted (see `remove_unfinished_files`).
/// @throws IoError naming the path and the system's reason; whatever `write` throws.
void write_output_file(const std::string& path,
                       const std::function<void(const std::string& temporary_path)>& write);

/// The same for text; "-" writes to standard output.
void write_output_text(const std::string& path, std::string_view text);

/// The temporary file that process `pid` fills before it becomes `target`.
std::filesystem::path temporary_path(const std::filesystem::path& target, int pid);

/// The process whose temporary file this is, and the name of the file that it was to become; none
/// for any other file.
struct TemporaryFile {
    int pid = 0;
    std::string target_name;
};
std::optional<TemporaryFile> parse_temporary_name(const std::string& name);

/// Deletes the temporary files of writes in progress. Async-signal-safe: for handlers of SIGINT and
/// the like.
void remove_unfinished_files() noexcept;

}  // namespace zskel
