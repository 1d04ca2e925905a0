#pragma once

#include <cstddef>
#include <functional>

namespace zskel {

/// Calls `body(begin, end)` on disjoint ranges that cover [0, count), in parallel.
/// Ranges hold at least `grain` items. Bodies must write only to their own items, so that results
/// do not depend on the number of threads. An exception of a body is rethrown here.
/// @throws std::bad_alloc when there is no memory for the threads.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Threads that `parallel_for` may use.
int thread_count();

/// Limits the threads of every later `parallel_for`; 0 means as many as the machine has.
void set_thread_limit(int threads);

}  // namespace zskel
