#include "batch/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace zskel::batch {

void Tally::add(const Record& record, const Record* before) {
    const bool is_old_failure =
        record.status == Status::Skipped && before != nullptr && before->status == Status::Failed;
    if (is_old_failure) {
        ++failed;
        ++failed_before;
        ++reasons[before->reason];
        return;
    }
    if (record.status == Status::Skipped) {
        ++skipped;
        return;
    }
    if (record.status == Status::Failed) ++reasons[record.reason];
    ++(record.status == Status::Ok ? ok : record.status == Status::Warned ? warned : failed);
    item_seconds += record.seconds;
    peak_memory_kib = std::max(peak_memory_kib, record.peak_memory_kib);
}

std::string summary_text(const Tally& tally) {
    std::string text =
        fmt::format("{} items = {} ok + {} warned + {} failed + {} skipped", tally.items, tally.ok,
                    tally.warned, tally.failed, tally.skipped);
    if (tally.left > 0) text += fmt::format(" + {} left", tally.left);
    text += fmt::format("\n{:.1f} s", tally.seconds);
    if (tally.worked_on() > 0 && tally.seconds > 0.0) {
        text += fmt::format(", {:.1f} items a second, at most {} MiB a worker",
                            static_cast<double>(tally.worked_on()) / tally.seconds,
                            tally.peak_memory_kib / 1024);
    }
    text += '\n';
    for (const auto& [reason, count] : tally.reasons)
        text += fmt::format("failed: {} {}\n", count, reason);
    if (tally.failed_before > 0) {
        text += fmt::format("{} of these failed before and were not tried again (--retry)\n",
                            tally.failed_before);
    }
    return text;
}

std::string summary_json(const Tally& tally) {
    const nlohmann::ordered_json out{{"items", tally.items},
                                     {"ok", tally.ok},
                                     {"warned", tally.warned},
                                     {"failed", tally.failed},
                                     {"skipped", tally.skipped},
                                     {"left", tally.left},
                                     {"failed_before", tally.failed_before},
                                     {"reasons", tally.reasons},
                                     {"seconds", tally.seconds},
                                     {"item_seconds", tally.item_seconds},
                                     {"peak_memory_kib", tally.peak_memory_kib}};
    return out.dump(2) + "\n";
}

}  // namespace zskel::batch
