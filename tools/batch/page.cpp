#include "batch/page.h"

#include <fmt/format.h>

#include <algorithm>

#include "zskel/io/markup.h"

namespace zskel::batch {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>zskel batch</title>
<style>
body { font: 15px/1.4 system-ui, sans-serif; margin: 2em; color: #223; }
table { border-collapse: collapse; }
td, th { padding: .3em .8em; text-align: left; vertical-align: top; border-top: 1px solid #ccd; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr.failed td:first-child { background: #f4c9bd; }
tr.warned td:first-child { background: #f6e7b5; }
tr.ok td:first-child { background: #cfe3d2; }
img { display: block; width: 160px; height: 120px; }
p.none { color: #667; }
</style></head><body><h1>zskel batch</h1>
)";

std::string remarks(const Record& record) {
    if (record.status == Status::Failed)
        return fmt::format("<b>{}</b>: {}", escaped_markup(record.reason),
                           escaped_markup(record.text));
    std::string text;
    for (const std::string& warning : record.warnings)
        text += (text.empty() ? "" : "<br>") + escaped_markup(warning);
    return text;
}

std::string thumbnail(const Record& record) {
    if (record.thumbnail.empty()) return "";
    return fmt::format("<img alt=\"\" src=\"data:image/png;base64,{}\">", record.thumbnail);
}

std::string row(const Record& record) {
    return fmt::format(
        "<tr class=\"{0}\"><td>{0}</td><td>{1}</td><td>{2}</td><td>{3}</td><td "
        "class=\"number\">{4:.3f}</td><td class=\"number\">{5}</td><td>{6}</td></tr>\n",
        name_of(record.status), thumbnail(record), escaped_markup(record.model), remarks(record),
        record.seconds, record.peak_memory_kib / 1024, escaped_markup(record.output));
}

// Why pictures are missing, of the first that could not be drawn.
std::string picture_note(const std::vector<const Record*>& records) {
    const auto none = std::find_if(records.begin(), records.end(), [](const Record* record) {
        return !record->no_thumbnail.empty();
    });
    if (none == records.end()) return "";
    return fmt::format("<p class=\"none\">Pictures are missing: {}</p>\n",
                       escaped_markup((*none)->no_thumbnail));
}

int rank(Status status) {
    return status == Status::Failed ? 0 : status == Status::Warned ? 1 : 2;
}

}  // namespace

std::string report_page(const std::vector<Item>& items, const Journal& journal,
                        const Tally& tally) {
    std::vector<const Record*> records;
    for (const Item& item : items) {
        if (const Record* record = journal.find(item.output)) records.push_back(record);
    }
    std::stable_sort(records.begin(), records.end(), [](const Record* a, const Record* b) {
        return rank(a->status) < rank(b->status);
    });
    std::string page = kHead;
    page += fmt::format("<pre>{}</pre>\n{}", escaped_markup(summary_text(tally)),
                        picture_note(records));
    page +=
        "<table><tr><th>status</th><th></th><th>model</th><th>remarks</th><th>seconds</th>"
        "<th>MiB</th><th>output</th></tr>\n";
    for (const Record* record : records) page += row(*record);
    return page + "</table></body></html>\n";
}

}  // namespace zskel::batch
