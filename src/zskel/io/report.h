#pragma once

#include <string>

#include "zskel/mesh/check.h"

namespace zskel {

/// The report as one JSON object, indented; keys are those of MeshReport, none is left out.
/// What has no value (no genus, no volume) is null. Ends with a line end.
std::string to_json(const MeshReport& report);

/// The report for people: a few lines of numbers, then one line a defect. Ends with a line end.
std::string to_text(const MeshReport& report);

}  // namespace zskel
