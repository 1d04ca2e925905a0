#include "batch/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "batch/csv.h"
#include "zskel/core/error.h"
#include "zskel/core/input_file.h"
#include "zskel/io/json_place.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Of JSON only surfaces by formula: a folder may hold skeletons too.
constexpr std::array<std::string_view, 10> kModelEndings = {
    ".obj", ".ply", ".stl", ".off", ".coff", ".noff", ".cnoff", ".stoff", ".bpt", ".surface.json"};

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // Excel's CSV begins with it

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_model(const std::string& path) {
    const std::string name = lower_case(path);
    return std::any_of(kModelEndings.begin(), kModelEndings.end(),
                       [&](std::string_view ending) { return name.ends_with(ending); });
}

template <typename Iterator>
void add_models(const std::string& folder, std::vector<std::string>& paths) {
    for (const fs::directory_entry& entry : Iterator(folder)) {
        if (!entry.is_directory() && is_model(entry.path().string()))
            paths.push_back(entry.path().string());
    }
}

std::vector<Entry> entries_of_folder(const std::string& folder, bool recursive) try {
    std::vector<std::string> paths;
    if (recursive) {
        add_models<fs::recursive_directory_iterator>(folder, paths);
    } else {
        add_models<fs::directory_iterator>(folder, paths);
    }
    if (paths.empty()) throw InputError(fmt::format("{}: no model is in this folder", folder));
    std::sort(paths.begin(), paths.end());
    std::vector<Entry> entries;
    for (std::string& path : paths) entries.push_back({std::move(path), "", {}});
    return entries;
} catch (const fs::filesystem_error& error) {
    throw InputError(fmt::format("{}: cannot be read: {}", folder, error.code().message()));
}

void put(Entry& entry, const std::string& column, std::string value) {
    if (column == "model") {
        entry.model = std::move(value);
    } else if (column == "output") {
        entry.output = std::move(value);
    } else {
        entry.fields[column] = std::move(value);
    }
}

// A manifest's own order of lines, without their ends; `use` is told each with its number.
template <typename Use>
void for_each_line(std::string_view text, const Use& use) {
    std::size_t number = 1;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (!line.empty()) use(line, number);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
    }
}

std::string text_of(const Json& value, const std::string& where) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number() || value.is_boolean()) return value.dump();
    throw InputError(
        fmt::format("{}: {} is neither a text nor a number", where, zskel::quoted(value.dump())));
}

Entry entry_of_json(std::string_view line, const std::string& where) {
    const Json object = parse_json(line, where);
    if (!object.is_object())
        throw InputError(fmt::format(R"({}: not an object such as {{"model": "a.obj"}})", where));
    Entry entry;
    for (const auto& [name, value] : object.items()) put(entry, name, text_of(value, where));
    if (entry.model.empty()) throw InputError(fmt::format("{}: no \"model\"", where));
    return entry;
}

}  // namespace

std::vector<Entry> entries_of_list(std::string_view text) {
    std::vector<Entry> entries;
    for_each_line(text, [&](std::string_view line, std::size_t) {
        if (!line.starts_with('#')) entries.push_back({std::string(line), "", {}});
    });
    return entries;
}

std::vector<Entry> entries_of_csv(std::string_view text, const std::string& name) {
    const std::vector<std::vector<std::string>> rows = parse_csv(text, name);
    if (rows.empty() || std::find(rows[0].begin(), rows[0].end(), "model") == rows[0].end())
        throw InputError(fmt::format("{}: the first line has no column \"model\"", name));
    std::vector<Entry> entries;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        if (rows[r].size() != rows[0].size()) {
            throw InputError(fmt::format("{}: row {} has {} fields, the header {}", name, r + 1,
                                         rows[r].size(), rows[0].size()));
        }
        Entry entry;
        for (std::size_t c = 0; c < rows[r].size(); ++c) put(entry, rows[0][c], rows[r][c]);
        if (entry.model.empty()) throw InputError(fmt::format("{}: row {}: no model", name, r + 1));
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::vector<Entry> entries_of_json_lines(std::string_view text, const std::string& name) {
    std::vector<Entry> entries;
    for_each_line(text, [&](std::string_view line, std::size_t number) {
        entries.push_back(entry_of_json(line, fmt::format("{}: line {}", name, number)));
    });
    return entries;
}

std::vector<Entry> read_manifest(const std::string& path, bool recursive) {
    std::error_code unknown;
    if (path != "-" && fs::is_directory(path, unknown)) return entries_of_folder(path, recursive);
    if (is_model(path)) return {{path, "", {}}};
    const FileBytes file = read_input_file(path, "a manifest");
    std::string_view text = file.text();
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const std::string name = lower_case(path);
    if (name.ends_with(".csv")) return entries_of_csv(text, path);
    if (name.ends_with(".jsonl") || name.ends_with(".ndjson"))
        return entries_of_json_lines(text, path);
    return entries_of_list(text);
}

}  // namespace zskel::batch
