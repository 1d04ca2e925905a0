#include "batch/machine.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>

#include "zskel/visibility/choose.h"

namespace zskel::batch {
namespace {

namespace fs = std::filesystem;

// The first number of a file, as control groups write them; `max` and a file that is not there: 0.
double number_in(const fs::path& path) {
    std::ifstream file(path);
    double value = 0.0;
    return file >> value ? value : 0.0;
}

// Cores that a container's share of time amounts to (cgroup 2); 0: all.
double core_quota(const fs::path& root) {
    std::ifstream file(root / "sys/fs/cgroup/cpu.max");
    double quota = 0.0;
    double period = 0.0;
    return file >> quota >> period && period > 0.0 ? quota / period : 0.0;
}

double available_bytes(const fs::path& root) {
    std::ifstream file(root / "proc/meminfo");
    std::string word;
    while (file >> word) {
        double kib = 0.0;
        if (word == "MemAvailable:" && file >> kib) return kib * 1024.0;
    }
    return 0.0;
}

}  // namespace

Machine look_at_machine(const fs::path& root) {
    Machine machine;
    // The cores that this process may run on.
    machine.cores = std::max(1U, std::thread::hardware_concurrency());
    const double quota = core_quota(root);
    if (quota > 0.0) {
        machine.cores =
            std::clamp(static_cast<std::size_t>(std::lround(quota)), std::size_t{1}, machine.cores);
    }
    double bytes = available_bytes(root);
    const double bound = number_in(root / "sys/fs/cgroup/memory.max");
    if (bound > 0.0) bytes = std::min(bytes, bound);
    machine.memory_bytes = static_cast<std::size_t>(bytes);
    machine.has_gpu = has_gpu_device(root / "dev");
    return machine;
}

std::size_t recommended_workers(const Machine& machine) {
    if (machine.memory_bytes == 0) return machine.cores;
    return std::clamp(machine.memory_bytes / kWorkerBytes, std::size_t{1}, machine.cores);
}

std::size_t memory_for_worker(const Machine& machine, std::size_t workers) {
    return machine.memory_bytes / 10 * 9 / std::max(workers, std::size_t{1});
}

}  // namespace zskel::batch
