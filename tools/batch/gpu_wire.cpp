#include "batch/gpu_wire.h"

#include <algorithm>
#include <vector>

namespace zskel::batch {
bool send_message(int socket, std::uint32_t what, std::uint32_t solid,
                  std::initializer_list<Bytes> parts) {
    Head head{what, solid, 0};
    for (const Bytes& part : parts) head.bytes += part.size();
    if (!send_all(socket, std::as_bytes(std::span(&head, 1)))) return false;
    return std::all_of(parts.begin(), parts.end(),
                       [socket](const Bytes& part) { return send_all(socket, part); });
}

// Fields that each end with a zero byte.
std::string to_text(const BackendInfo& info) {
    std::string text;
    const auto add = [&text](const std::string& field) { text.append(field).push_back('\0'); };
    for (const std::string& field : {info.name, info.vendor, info.renderer, info.version})
        add(field);
    for (const gl::FailedAttempt& attempt : info.failed) {
        add(attempt.candidate);
        add(attempt.reason);
    }
    return text;
}

BackendInfo backend_info_of(const std::string& text) {
    std::vector<std::string> fields;
    for (std::size_t at = 0, end = 0; (end = text.find('\0', at)) != std::string::npos;
         at = end + 1)
        fields.push_back(text.substr(at, end - at));
    constexpr std::size_t kOwn = 4;
    fields.resize(std::max(fields.size(), kOwn));
    BackendInfo info;
    info.name = fields[0];
    info.vendor = fields[1];
    info.renderer = fields[2];
    info.version = fields[3];
    info.is_raster = true;
    for (std::size_t i = kOwn; i + 1 < fields.size(); i += 2)
        info.failed.push_back({fields[i], fields[i + 1]});
    return info;
}

}  // namespace zskel::batch
