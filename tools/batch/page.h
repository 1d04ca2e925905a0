#pragma once

#include <string>
#include <vector>

#include "batch/item.h"
#include "batch/journal.h"
#include "batch/tally.h"

namespace zskel::batch {

/// A page about a batch, in one file that needs no network: the tally, and of every item what the
/// journal says, those that failed first, with a thumbnail where there is one.
std::string report_page(const std::vector<Item>& items, const Journal& journal, const Tally& tally);

}  // namespace zskel::batch
