#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "batch/record.h"
#include "batch/request.h"

namespace zskel::batch {

struct PoolOptions {
    std::size_t workers = 1;
    double item_timeout_s = 0.0;  ///< 0: none
};

class Worker;

/// Processes that do one item after the other, each started when it is first needed. One that
/// crashes, takes too long or runs out of memory costs the item that it had, and another takes its
/// place. An item for which a used worker has no memory left, or whose worker was killed by SIGKILL
/// from outside, is tried once more by a fresh one; and one whose backend failed is tried once more
/// alone.
///
/// A worker gets requests (request.h) on its socket and answers each with `BEGUN key backend`,
/// perhaps, and the record: lines both.
class WorkerPool {
  public:
    /// @param launch  what a new process does with its end of the socket; it does not return.
    WorkerPool(const PoolOptions& options, std::function<void(int socket)> launch);
    ~WorkerPool();  ///< kills what still runs
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    bool has_idle() const;
    std::size_t busy() const;

    /// Gives the request to an idle worker. @throws Error when no process can be started.
    void give(const Request& request);

    /// The records of what has ended, waiting for the first of them if need be.
    /// @param most     to wait at most.
    /// @param wake_fd  returns too when this can be read from; -1: none.
    std::vector<Record> wait(std::chrono::milliseconds most, int wake_fd);

    /// Kills all workers. What they had is not answered for, and their temporary files are removed.
    void kill_all();

  private:
    std::chrono::milliseconds until_deadline(std::chrono::milliseconds most) const;
    void settle(Worker& worker, std::vector<Record>& records);

    PoolOptions options_;
    std::function<void(int)> launch_;
    std::vector<std::unique_ptr<Worker>> workers_;
};

/// The line that tells of a begun item.
std::string begun_line(const Record& record);

}  // namespace zskel::batch
