#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "batch/record.h"

namespace zskel::batch {

/// How a batch has gone: items = ok + warned + failed + skipped, and `left` where it was stopped.
struct Tally {
    std::size_t items = 0;
    std::size_t ok = 0;
    std::size_t warned = 0;
    std::size_t failed = 0;                      ///< now, or in an earlier run and not tried again
    std::size_t skipped = 0;                     ///< done by an earlier run
    std::size_t left = 0;                        ///< not come to an end when the batch was stopped
    std::size_t failed_before = 0;               ///< of `failed`, those of an earlier run
    std::map<std::string, std::size_t> reasons;  ///< of `failed`
    double seconds = 0.0;                        ///< of the whole batch
    double item_seconds = 0.0;                   ///< of the items worked on now, summed up
    long peak_memory_kib = 0;                    ///< the most that one of them took

    /// Counts an item; `before` is what an earlier run found out, of one that is skipped.
    void add(const Record& record, const Record* before);
    std::size_t done() const { return ok + warned + failed + skipped; }
    std::size_t worked_on() const { return done() - skipped - failed_before; }
};

std::string summary_text(const Tally& tally);
std::string summary_json(const Tally& tally);

}  // namespace zskel::batch
