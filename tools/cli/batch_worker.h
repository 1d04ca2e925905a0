#pragma once

namespace zskel::cli {

/// What a batch tells its workers beside the command line, which is the same for both.
struct WorkerOrders {
    int socket = -1;
    double memory_mb = 0.0;  ///< 0: no bound
    int threads = 0;         ///< 0: as many as the machine has
};

/// Whether this process was started as a worker.
bool is_batch_worker();

/// What it was told. Only for workers.
WorkerOrders worker_orders();

/// Runs this program anew, in this process, with the same command line and as a worker on that
/// socket: memory and threads are then its own. Called in a child of the batch; does not return.
[[noreturn]] void become_worker(int socket, const WorkerOrders& orders);

}  // namespace zskel::cli
