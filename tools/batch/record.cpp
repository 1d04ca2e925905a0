#include "batch/record.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

namespace zskel::batch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<Status, std::string_view>, 4> kStatusNames{{
    {Status::Ok, "ok"},
    {Status::Warned, "warned"},
    {Status::Failed, "failed"},
    {Status::Skipped, "skipped"},
}};

std::optional<Status> parse_status(const std::string& name) {
    for (const auto& [status, known] : kStatusNames) {
        if (known == name) return status;
    }
    return std::nullopt;
}

}  // namespace

std::string_view name_of(Status status) {
    return kStatusNames[static_cast<std::size_t>(status)].second;
}

std::string to_line(const Record& record) {
    Json out{{"model", record.model},
             {"output", record.output},
             {"status", name_of(record.status)},
             {"reason", record.reason},
             {"exit_code", record.exit_code},
             {"text", record.text},
             {"warnings", record.warnings},
             {"seconds", record.seconds},
             {"peak_memory_kib", record.peak_memory_kib},
             {"backend", record.backend},
             {"key", record.key}};
    if (!record.thumbnail.empty()) out["thumbnail"] = record.thumbnail;
    if (!record.no_thumbnail.empty()) out["no_thumbnail"] = record.no_thumbnail;
    return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<Record> parse_record(std::string_view line) try {
    const Json in = Json::parse(line);
    Record record;
    const std::optional<Status> status = parse_status(in.at("status").get<std::string>());
    if (!status) return std::nullopt;
    record.status = *status;
    in.at("model").get_to(record.model);
    in.at("output").get_to(record.output);
    in.at("reason").get_to(record.reason);
    in.at("exit_code").get_to(record.exit_code);
    in.at("text").get_to(record.text);
    in.at("warnings").get_to(record.warnings);
    in.at("seconds").get_to(record.seconds);
    in.at("peak_memory_kib").get_to(record.peak_memory_kib);
    in.at("backend").get_to(record.backend);
    in.at("key").get_to(record.key);
    record.thumbnail = in.value("thumbnail", "");
    record.no_thumbnail = in.value("no_thumbnail", "");
    return record;
} catch (const Json::exception&) {
    return std::nullopt;
}

}  // namespace zskel::batch
