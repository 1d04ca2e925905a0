#pragma once

#include <optional>
#include <string>

namespace zskel::batch {

/// What a worker is asked to do.
struct Request {
    /// What an earlier run has found out about this output: its key, and whether it failed.
    struct Known {
        std::string key;
        bool has_failed = false;
    };
    std::string model;
    std::string output;
    std::optional<Known> known;
    bool wants_thumbnail = false;
    bool is_alone = false;  ///< no process that others use too is to have a part in it
};

/// The bytes that say so: fields that each end with a zero byte, since names may hold any other.
std::string to_message(const Request& request);

/// Takes the first whole message out of `bytes`; nothing while there is none.
std::optional<Request> take_request(std::string& bytes);

}  // namespace zskel::batch
