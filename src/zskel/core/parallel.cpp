#include "zskel/core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>

#include "zskel/core/loop_order.h"

namespace zskel {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    LoopOrder order;
    try {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                          [&](const tbb::blocked_range<std::size_t>& range)
                              ZSKEL_CALLED_BY_LIBRARY {
                                  const LoopOrder::Body ordered(order);
                                  body(range.begin(), range.end());
                              });
    } catch (const std::runtime_error& error) {
        // TBB has no type of its own for a thread whose stack there is no memory for.
        if (std::string_view(error.what()).starts_with("pthread_create")) throw std::bad_alloc();
        throw;
    }
}

int thread_count() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void set_thread_limit(int threads) {
    static std::unique_ptr<tbb::global_control> limit;
    limit.reset();
    if (threads > 0) {
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads));
    }
}

}  // namespace zskel
