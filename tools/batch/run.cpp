#include "batch/run.h"

#include <algorithm>
#include <chrono>

#include "batch/progress_line.h"
#include "batch/stale_files.h"
#include "batch/stop_signals.h"

namespace zskel::batch {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kGrace(1000);
constexpr milliseconds kGlance(500);  // how often progress is drawn when nothing happens

class BatchRun {
  public:
    BatchRun(const std::vector<Item>& items, const RunOptions& options, Journal& journal,
             const std::function<void(int)>& launch)
        : items_(items),
          options_(options),
          journal_(journal),
          pool_(options.pool, launch),
          progress_(options.shows_progress) {
        tally_.items = items.size();
    }

    RunResult run() {
        while (signals_.first() == 0 && (next_ < items_.size() || pool_.busy() > 0)) {
            while (next_ < items_.size() && pool_.has_idle()) give_next();
            const std::vector<Record> records = pool_.wait(kGlance, signals_.wake_fd());
            take(records);
            tend_gpu(records);
            progress_.show(tally_);
        }
        if (signals_.first() != 0) wind_down();
        pool_.kill_all();
        journal_.flush();
        tally_.left = tally_.items - tally_.done();
        tally_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        return {tally_, signals_.first()};
    }

  private:
    void give_next() {
        const Item& item = items_[next_];
        Request request{item.model, item.output, std::nullopt, next_ < options_.thumbnails};
        const Record* known = journal_.find(item.output);
        const bool has_failed = known != nullptr && known->status == Status::Failed;
        if (known != nullptr && !(has_failed && options_.retry))
            request.known = {known->key, has_failed};
        pool_.give(request);
        ++next_;
    }

    void take(const std::vector<Record>& records) {
        for (const Record& record : records) {
            tally_.add(record, journal_.find(record.output));
            if (record.status != Status::Skipped) journal_.append(record);
        }
    }

    // It may be the GPU that hangs, and with it all who use it.
    void tend_gpu(const std::vector<Record>& records) {
        if (options_.gpu == nullptr) return;
        const bool has_timed_out =
            std::any_of(records.begin(), records.end(),
                        [](const Record& record) { return record.reason == "timeout"; });
        if (has_timed_out) options_.gpu->replace_if_hung();
        options_.gpu->tend();
    }

    // Those in work may end, for a little while.
    void wind_down() {
        const Clock::time_point deadline = Clock::now() + kGrace;
        while (pool_.busy() > 0 && signals_.count() < 2) {
            const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
            if (left.count() <= 0) break;
            signals_.forget_wake();
            take(pool_.wait(left, signals_.wake_fd()));
        }
    }

    const std::vector<Item>& items_;
    const RunOptions& options_;
    Journal& journal_;
    StopSignals signals_;
    WorkerPool pool_;
    ProgressLine progress_;
    Tally tally_;
    std::size_t next_ = 0;
    Clock::time_point start_ = Clock::now();
};

}  // namespace

RunResult run_items(const std::vector<Item>& items, const RunOptions& options, Journal& journal,
                    const std::function<void(int)>& launch) {
    remove_stale_files(items);
    RunResult result = BatchRun(items, options, journal, launch).run();
    remove_stale_files(items);
    return result;
}

}  // namespace zskel::batch
