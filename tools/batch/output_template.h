#pragma once

#include <cstddef>
#include <string>

#include "batch/item.h"

namespace zskel::batch {

/// A template filled in: {stem} is the model's name without folder and extension, {name} with the
/// extension, {dir} its folder ("." for none), {index} its number in the manifest from 0, and
/// {COLUMN} what the manifest says in that column; {{ and }} stand for braces.
/// @throws UsageError for a name that the entry does not have, or a brace that is not closed.
std::string fill_template(const std::string& pattern, const Entry& entry, std::size_t index);

}  // namespace zskel::batch
