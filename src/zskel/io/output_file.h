#pragma once

#include <functional>
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

/// Deletes the temporary files of writes in progress. Async-signal-safe: for handlers of SIGINT and
/// the like.
void remove_unfinished_files() noexcept;

}  // namespace zskel
