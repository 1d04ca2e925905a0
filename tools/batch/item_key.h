#pragma once

#include <string>
#include <string_view>

#include "batch/skeleton_maker.h"

namespace zskel::batch {

/// Tells whether a skeleton is still the one that would be made: a hash of the model's bytes and
/// all that acts on what is written, which is the options, the version and the resolved backend.
/// Limits do not count.
std::string item_key(std::string_view model_bytes, const Task& task, SkeletonFormat format,
                     const std::string& backend);

}  // namespace zskel::batch
