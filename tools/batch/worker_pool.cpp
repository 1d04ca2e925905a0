#include "batch/worker_pool.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "batch/worker_process.h"

namespace zskel::batch {
namespace {

using std::chrono::milliseconds;

}  // namespace

WorkerPool::WorkerPool(const PoolOptions& options, std::function<void(int)> launch)
    : options_(options), launch_(std::move(launch)) {
    for (std::size_t i = 0; i < options.workers; ++i)
        workers_.push_back(std::make_unique<Worker>(launch_));
}

WorkerPool::~WorkerPool() = default;

bool WorkerPool::has_idle() const {
    return busy() < workers_.size();
}

std::size_t WorkerPool::busy() const {
    return static_cast<std::size_t>(std::count_if(
        workers_.begin(), workers_.end(), [](const auto& worker) { return worker->is_busy(); }));
}

void WorkerPool::give(const Request& request) {
    const auto idle = std::find_if(workers_.begin(), workers_.end(),
                                   [](const auto& worker) { return !worker->is_busy(); });
    std::optional<Clock::duration> timeout;
    if (options_.item_timeout_s > 0.0) {
        timeout = std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(options_.item_timeout_s));
    }
    (*idle)->give(request, timeout);
}

milliseconds WorkerPool::until_deadline(milliseconds most) const {
    const Clock::time_point now = Clock::now();
    for (const auto& worker : workers_) {
        if (!worker->deadline()) continue;
        const auto left = std::chrono::ceil<milliseconds>(*worker->deadline() - now);
        most = std::clamp(left, milliseconds(0), most);
    }
    return most;
}

void WorkerPool::settle(Worker& worker, std::vector<Record>& records) {
    if (std::optional<Record> record = worker.receive()) {
        records.push_back(std::move(*record));
    } else if (worker.deadline() && Clock::now() >= *worker.deadline()) {
        records.push_back(worker.time_out(options_.item_timeout_s));
    }
}

std::vector<Record> WorkerPool::wait(milliseconds most, int wake_fd) {
    std::vector<pollfd> watched{{wake_fd, POLLIN, 0}};  // poll passes over -1
    for (const auto& worker : workers_) watched.push_back({worker->socket(), POLLIN, 0});
    ::poll(watched.data(), watched.size(), static_cast<int>(until_deadline(most).count()));
    std::vector<Record> records;
    for (const auto& worker : workers_) {
        if (worker->socket() >= 0) settle(*worker, records);
    }
    return records;
}

void WorkerPool::kill_all() {
    for (const auto& worker : workers_) worker->stop();
}

}  // namespace zskel::batch
