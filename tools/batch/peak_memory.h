#pragma once

namespace zskel::batch {

/// Begins to measure the peak anew, where the system allows it.
void forget_peak_memory();

/// The most memory that was resident in this process since then, in KiB; 0 where it is not known.
long peak_memory_kib();

}  // namespace zskel::batch
