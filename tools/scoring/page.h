#pragma once

#include <string>
#include <vector>

#include "scoring/table.h"

namespace zskel::scoring {

/// The table with pictures as one HTML page that needs nothing beside it: pictures within, a
/// legend of all measures, rows that a click on a heading sorts.
/// @param subtitle    what was scored.
/// @param no_picture  why there are no pictures; empty where there are.
std::string page_html(const std::vector<Row>& rows, const std::string& subtitle,
                      const std::string& no_picture);

}  // namespace zskel::scoring
