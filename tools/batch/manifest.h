#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/item.h"

namespace zskel::batch {

/// The models that a manifest names, in its order. A folder: the models in it, by name (with
/// `recursive` those of its folders too). A model's file: itself. .csv: a header with a column
/// `model`, perhaps `output`, and others for the template. .jsonl, .ndjson: an object a line with
/// the same members. Any other file, and "-" for standard input: a path a line; empty lines and
/// those that begin with # are left out. Paths are as seen from the current folder.
/// @throws InputError naming file, line and value.
std::vector<Entry> read_manifest(const std::string& path, bool recursive);

/// The same of text at hand; `name` stands in messages.
std::vector<Entry> entries_of_list(std::string_view text);
std::vector<Entry> entries_of_csv(std::string_view text, const std::string& name);
std::vector<Entry> entries_of_json_lines(std::string_view text, const std::string& name);

}  // namespace zskel::batch
