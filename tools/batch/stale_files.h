#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "batch/item.h"

namespace zskel::batch {

/// Whether a process is there and runs: one that has ended and waits for its parent does not.
bool is_running(int pid, const std::filesystem::path& proc = "/proc");

/// Removes the temporary files that processes which are no more have left of these items' outputs.
/// Files of other outputs stay: another machine's process may be writing them.
/// @return how many there were.
std::size_t remove_stale_files(const std::vector<Item>& items);

/// Removes the temporary file that process `pid`, which has ended, left of one output, if it did.
void remove_stale_file(const std::string& output, int pid);

}  // namespace zskel::batch
