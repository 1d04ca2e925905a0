#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "batch/item.h"

namespace zskel::batch {

/// One part of a batch that is cut into `count`: item i belongs to part i % count + 1.
struct Shard {
    std::size_t number = 1;  ///< from 1
    std::size_t count = 1;
};

/// Reads "I/N", I from 1 to N. @throws UsageError.
Shard parse_shard(const std::string& text);

/// Every entry with its output, by the template where the manifest names none.
/// @throws UsageError when either is "-".
std::vector<Item> plan_items(const std::vector<Entry>& entries, const std::string& pattern);

/// What a batch reads and writes beside its items.
struct BatchFiles {
    std::vector<std::string> manifests;
    std::string journal;
    std::string report;  ///< empty: none
};

/// Refuses what would replace what: an output, the journal or the report that is a manifest, a
/// model, or one another. @param items  of all shards. @throws UsageError.
void check_files(const std::vector<Item>& items, const BatchFiles& files);

/// The items of one shard, in their order.
std::vector<Item> items_of_shard(const std::vector<Item>& items, const Shard& shard);

/// Makes the folders that the outputs go to. @throws IoError.
void make_folders(const std::vector<Item>& items);

}  // namespace zskel::batch
