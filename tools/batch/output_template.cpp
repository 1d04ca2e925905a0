#include "batch/output_template.h"

#include <fmt/format.h>

#include <filesystem>

#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

std::string stem_of(const std::filesystem::path& model) {
    std::string stem = model.stem().string();
    if (model.extension() == ".json" && stem.ends_with(".surface"))
        stem.resize(stem.size() - std::string_view(".surface").size());
    return stem;
}

std::string value_of(const std::string& name, const Entry& entry, std::size_t index) {
    const std::filesystem::path model(entry.model);
    if (name == "stem") return stem_of(model);
    if (name == "name") return model.filename().string();
    if (name == "index") return fmt::to_string(index);
    if (name == "dir") {
        std::string folder = model.parent_path().string();
        return folder.empty() ? "." : folder;
    }
    const auto field = entry.fields.find(name);
    if (field != entry.fields.end()) {
        if (field->second.empty()) {
            throw UsageError(fmt::format("--output: {{{}}} is empty for {}", name, entry.model));
        }
        return field->second;
    }
    std::string known = "stem, name, dir, index";
    for (const auto& [column, value] : entry.fields) known += ", " + column;
    throw UsageError(fmt::format("--output: {{{}}} is not known; {} are", name, known));
}

}  // namespace

std::string fill_template(const std::string& pattern, const Entry& entry, std::size_t index) {
    std::string out;
    for (std::size_t at = 0; at < pattern.size(); ++at) {
        const char c = pattern[at];
        const bool is_doubled = at + 1 < pattern.size() && pattern[at + 1] == c;
        if ((c == '{' || c == '}') && is_doubled) {
            out += c;
            ++at;
        } else if (c == '{') {
            const std::size_t end = pattern.find('}', at);
            if (end == std::string::npos)
                throw UsageError(fmt::format("--output {}: a brace is not closed", pattern));
            out += value_of(pattern.substr(at + 1, end - at - 1), entry, index);
            at = end;
        } else {
            out += c;
        }
    }
    return out;
}

}  // namespace zskel::batch
