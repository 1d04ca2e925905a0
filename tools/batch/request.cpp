#include "batch/request.h"

#include <array>
#include <cstddef>

namespace zskel::batch {
namespace {

constexpr std::size_t kFields = 6;

// The third field.
constexpr const char* kUnknown = "unknown";
constexpr const char* kDone = "done";
constexpr const char* kFailed = "failed";

}  // namespace

std::string to_message(const Request& request) {
    const char* const known = !request.known              ? kUnknown
                              : request.known->has_failed ? kFailed
                                                          : kDone;
    std::string message;
    for (const std::string& field : {request.model, request.output, std::string(known),
                                     request.known ? request.known->key : std::string(),
                                     std::string(request.wants_thumbnail ? "thumbnail" : ""),
                                     std::string(request.is_alone ? "alone" : "")}) {
        message += field;
        message += '\0';
    }
    return message;
}

std::optional<Request> take_request(std::string& bytes) {
    std::array<std::string, kFields> fields;
    std::size_t at = 0;
    for (std::string& field : fields) {
        const std::size_t end = bytes.find('\0', at);
        if (end == std::string::npos) return std::nullopt;
        field = bytes.substr(at, end - at);
        at = end + 1;
    }
    bytes.erase(0, at);
    Request request;
    request.model = fields[0];
    request.output = fields[1];
    if (fields[2] != kUnknown) request.known = {fields[3], fields[2] == kFailed};
    request.wants_thumbnail = !fields[4].empty();
    request.is_alone = !fields[5].empty();
    return request;
}

}  // namespace zskel::batch
