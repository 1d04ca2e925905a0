#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "batch/gpu_process.h"
#include "batch/item.h"
#include "batch/journal.h"
#include "batch/tally.h"
#include "batch/worker_pool.h"

namespace zskel::batch {

struct RunOptions {
    PoolOptions pool;
    bool retry = false;          ///< what failed before is tried again
    std::size_t thumbnails = 0;  ///< of the first so many items
    bool shows_progress = false;
    GpuProcess* gpu = nullptr;  ///< that workers share, if they do
};

struct RunResult {
    Tally tally;
    int signal = 0;  ///< that stopped it; 0: it came to its end
};

/// Works on the items in their order and puts what becomes of each into the journal. On SIGINT,
/// SIGTERM and SIGHUP no item is begun any more, those in work have a second to end, and what has
/// not ended is as if it had never begun; a second signal cuts that second short.
/// @param launch  see WorkerPool. @throws IoError when the journal cannot be written, Error when no
/// worker can be started.
RunResult run_items(const std::vector<Item>& items, const RunOptions& options, Journal& journal,
                    const std::function<void(int socket)>& launch);

}  // namespace zskel::batch
