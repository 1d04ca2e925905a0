// Any bytes as a manifest: the first byte chooses the form, the rest of the first line is the
// template of the outputs. What was read is planned, and read back from a manifest written of it.
#include <algorithm>
#include <string>
#include <vector>

#include "batch/csv.h"
#include "batch/manifest.h"
#include "batch/plan.h"
#include "fuzz.h"

using namespace zskel;
using namespace zskel::batch;

namespace {

std::string csv_of(const std::vector<Entry>& entries) {
    std::string out = "model,output\n";
    for (const Entry& entry : entries)
        out += csv_field(entry.model) + "," + csv_field(entry.output) + "\n";
    return out;
}

std::vector<Entry> entries_of(char form, std::string_view text) {
    if (form == 'c') return entries_of_csv(text, "manifest");
    if (form == 'j') return entries_of_json_lines(text, "manifest");
    return entries_of_list(text);
}

void check(const std::vector<Entry>& entries) {
    const std::vector<Entry> again = entries_of_csv(csv_of(entries), "written");
    fuzz::require(again.size() == entries.size(), "every entry is written");
    for (std::size_t i = 0; i < entries.size(); ++i) {
        fuzz::require(!entries[i].model.empty(), "an entry names its model");
        fuzz::require(again[i].model == entries[i].model && again[i].output == entries[i].output,
                      "what was written is what is read");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view bytes = fuzz::text_of(data + 1, size - 1);
    const std::size_t line = std::min(bytes.find('\n'), bytes.size());
    fuzz::answer([&] {
        const std::vector<Entry> entries =
            entries_of(static_cast<char>(data[0]), bytes.substr(std::min(line + 1, bytes.size())));
        check(entries);
        const std::vector<Item> items = plan_items(entries, std::string(bytes.substr(0, line)));
        fuzz::require(items.size() == entries.size(), "every entry is an item");
        check_files(items, {{"manifest"}, "journal", "report"});
    });
    return 0;
}
