#pragma once

#include "model.h"

#include <filesystem>

namespace zskel::models {

/// The precision of coordinates in the files.
constexpr double kFileStep = 1e-5;

/// Writes NAME.obj, or NAME.bpt where it has patches, and NAME.skeleton.json into `folder`; the
/// same model gives the same bytes.
/// @throws std::runtime_error when a file cannot be written.
void write_model(const Model& model, const std::filesystem::path& folder);

}  // namespace zskel::models
