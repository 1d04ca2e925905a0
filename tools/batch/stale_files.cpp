#include "batch/stale_files.h"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <set>
#include <string>

#include "zskel/io/output_file.h"

namespace zskel::batch {
namespace {

namespace fs = std::filesystem;

std::size_t clean_folder(const fs::path& folder, const std::set<std::string>& names) {
    std::vector<fs::path> stale;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const auto found = parse_temporary_name(at->path().filename().string());
        if (found && names.contains(found->target_name) && !is_running(found->pid))
            stale.push_back(at->path());
    }
    for (const fs::path& path : stale) fs::remove(path, error);
    return stale.size();
}

}  // namespace

// The state stands behind the name, which is in parentheses and may hold any other.
bool is_running(int pid, const fs::path& proc) {
    std::ifstream file(proc / fmt::to_string(pid) / "stat");
    std::string text;
    if (!std::getline(file, text, '\0')) return false;
    const std::size_t state = text.rfind(") ");
    if (state == std::string::npos || state + 2 >= text.size()) return false;
    return text[state + 2] != 'Z' && text[state + 2] != 'X';
}

std::size_t remove_stale_files(const std::vector<Item>& items) {
    std::map<fs::path, std::set<std::string>> names;
    for (const Item& item : items) {
        const fs::path output(item.output);
        const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
        names[folder].insert(output.filename().string());
    }
    std::size_t count = 0;
    for (const auto& [folder, outputs] : names) count += clean_folder(folder, outputs);
    return count;
}

void remove_stale_file(const std::string& output, int pid) {
    std::error_code unknown;
    fs::path target = fs::canonical(output, unknown);
    if (unknown) target = output;
    fs::remove(temporary_path(target, pid), unknown);
}

}  // namespace zskel::batch
