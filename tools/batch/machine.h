#pragma once

#include <cstddef>
#include <filesystem>

namespace zskel::batch {

/// What a batch may use of the machine: what the system, a container and a cluster's node leave it.
struct Machine {
    std::size_t cores = 1;
    std::size_t memory_bytes = 0;  ///< that can still be had; 0: not known
    bool has_gpu = false;
};

/// @param root  of the file system.
Machine look_at_machine(const std::filesystem::path& root = "/");

/// What a worker may take of memory with models of up to 100,000 faces, more than twice what
/// was measured (tools/bench/RESULTS.md).
inline constexpr std::size_t kWorkerBytes = std::size_t{256} << 20;

/// One worker a core, as far as memory goes.
std::size_t recommended_workers(const Machine& machine);

/// Of the memory that is left nine tenths, in equal parts; 0 where it is not known.
std::size_t memory_for_worker(const Machine& machine, std::size_t workers);

}  // namespace zskel::batch
