#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zskel::batch {

enum class Status {
    Ok,
    Warned,   ///< a skeleton, with warnings
    Failed,   ///< no skeleton, or with --strict one that fails its self-check
    Skipped,  ///< nothing to do: an earlier run has done it
};
std::string_view name_of(Status status);

/// What became of an item: a line of the journal.
struct Record {
    std::string model;
    std::string output;
    Status status = Status::Failed;
    /// Why it failed, in one of these words: bad_input, no_backend, cannot_write, self_check,
    /// limit, memory, timeout, crashed, internal. Empty otherwise.
    std::string reason;
    int exit_code = 0;  ///< what `zskel extract` would have ended with; 128 + signal for a crash
    std::string text;   ///< the message
    std::vector<std::string> warnings;
    double seconds = 0.0;
    long peak_memory_kib = 0;  ///< resident, of the worker while it had the item
    std::string backend;       ///< the one that answered
    std::string key;           ///< see item_key.h; empty where the model could not be read
    std::string thumbnail;     ///< a PNG, base64; empty where none was asked for or drawn
    std::string no_thumbnail;  ///< why none could be drawn
};

/// One line of JSON, without its end.
std::string to_line(const Record& record);

/// The record of such a line; nothing for one that is torn or no record.
std::optional<Record> parse_record(std::string_view line);

}  // namespace zskel::batch
