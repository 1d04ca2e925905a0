#pragma once

#include <string>

namespace zskel::cli {

/// What a process of a batch does.
enum class WorkerRole { Items, Gpu };

/// What a batch tells its workers beside the command line, which is the same for both.
struct WorkerOrders {
    WorkerRole role = WorkerRole::Items;
    int socket = -1;          ///< to the batch; of the GPU's process: that workers connect to
    double memory_mb = 0.0;   ///< 0: no bound
    int threads = 0;          ///< 0: as many as the machine has
    std::string gpu_address;  ///< of the GPU's process; empty: there is none
};

/// Whether this process was started as a worker.
bool is_batch_worker();

/// What it was told. Only for workers.
WorkerOrders worker_orders();

/// Runs this program anew, in this process, with the same command line and as a worker with these
/// orders: memory and threads are then its own. Called in a child of the batch; does not return.
[[noreturn]] void become_worker(const WorkerOrders& orders);

}  // namespace zskel::cli
