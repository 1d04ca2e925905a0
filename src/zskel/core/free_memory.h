#pragma once

namespace zskel {

/// Gives what the heap holds free back to the system, where the heap can (glibc): what comes next
/// does then not add to the greatest memory that was in use at once. Some milliseconds for large
/// heaps.
void return_free_memory();

}  // namespace zskel
