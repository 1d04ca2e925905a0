#include "batch/plan.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <set>
#include <string_view>
#include <unordered_map>

#include "batch/output_template.h"
#include "zskel/core/error.h"

namespace zskel::batch {
namespace {

namespace fs = std::filesystem;

bool parse_number(std::string_view text, std::size_t& value) {
    const char* const start = text.data();
    const char* const end = start + text.size();
    const auto [stop, error] = std::from_chars(start, end, value);
    return error == std::errc() && stop == end;
}

// One spelling a file. The file system is asked about each folder once, not about each of a hundred
// thousand files.
class Spelling {
  public:
    std::string operator()(const std::string& path) {
        const fs::path plain = (here_ / path).lexically_normal();
        const auto [folder, is_new] = folders_.emplace(plain.parent_path().string(), "");
        if (is_new) {
            std::error_code unknown;
            const fs::path found = fs::weakly_canonical(plain.parent_path(), unknown);
            folder->second = unknown ? folder->first : found.string();
        }
        return folder->second + "/" + plain.filename().string();
    }

  private:
    fs::path here_ = fs::current_path();
    std::unordered_map<std::string, std::string> folders_;
};

}  // namespace

Shard parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    Shard shard;
    const bool fine = slash != std::string::npos &&
                      parse_number(std::string_view(text).substr(0, slash), shard.number) &&
                      parse_number(std::string_view(text).substr(slash + 1), shard.count) &&
                      shard.number >= 1 && shard.number <= shard.count;
    if (!fine) throw UsageError(fmt::format("--shard {}: give I/N, I from 1 to N", text));
    return shard;
}

std::vector<Item> plan_items(const std::vector<Entry>& entries, const std::string& pattern) {
    std::vector<Item> items;
    items.reserve(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        std::string output = entry.output.empty() ? fill_template(pattern, entry, i) : entry.output;
        if (entry.model == "-" || output == "-" || output.empty()) {
            throw UsageError(
                fmt::format("item {}: models and outputs of a batch are files, not '{}'", i,
                            entry.model == "-" ? entry.model : output));
        }
        if ((entry.model + output).find('\0') != std::string::npos)
            throw UsageError(fmt::format("item {}: a name holds a zero byte", i));
        items.push_back({i, entry.model, std::move(output)});
    }
    return items;
}

void check_files(const std::vector<Item>& items, const BatchFiles& files) {
    Spelling spelling;
    std::unordered_map<std::string, const Item*> by_output;
    for (const Item& item : items) {
        const auto [other, is_new] = by_output.emplace(spelling(item.output), &item);
        if (is_new) continue;
        throw UsageError(fmt::format(
            "{}: the output of two models, {} and {}; --output can tell them apart by {{dir}} or "
            "{{index}}",
            item.output, other->second->model, item.model));
    }
    std::unordered_map<std::string, std::string> others;  // and what they are
    const auto take = [&](const std::string& path, const char* what) {
        if (path.empty() || path == "-") return;
        const auto [other, is_new] = others.emplace(spelling(path), what);
        if (!is_new && !(other->second == what))
            throw UsageError(fmt::format("{}: is {} and {}", path, other->second, what));
    };
    for (const std::string& manifest : files.manifests) take(manifest, "a manifest");
    take(files.journal, "the journal");
    take(files.report, "the report");
    const auto check_model = [&](const Item& item) {
        const std::string model = spelling(item.model);
        const auto output = by_output.find(model);
        if (output != by_output.end()) {
            throw UsageError(fmt::format("{}: the output of {} would replace this model",
                                         item.model, output->second->model));
        }
        const auto other = others.find(model);
        // A manifest may be the model itself.
        if (other != others.end() && other->second != "a manifest")
            throw UsageError(
                fmt::format("{}: {} would replace this model", item.model, other->second));
    };
    for (const Item& item : items) check_model(item);
    for (const auto& [path, what] : others) {
        const auto output = by_output.find(path);
        if (output != by_output.end()) {
            throw UsageError(fmt::format("{}: the output of {} is {} too", output->second->output,
                                         output->second->model, what));
        }
    }
}

std::vector<Item> items_of_shard(const std::vector<Item>& items, const Shard& shard) {
    std::vector<Item> mine;
    for (std::size_t i = shard.number - 1; i < items.size(); i += shard.count)
        mine.push_back(items[i]);
    return mine;
}

void make_folders(const std::vector<Item>& items) {
    std::set<fs::path> folders;
    for (const Item& item : items) folders.insert(fs::path(item.output).parent_path());
    for (const fs::path& folder : folders) {
        std::error_code error;
        if (!folder.empty()) fs::create_directories(folder, error);
        if (error) {
            throw IoError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
        }
    }
}

}  // namespace zskel::batch
