#pragma once

#include <string>
#include <vector>

#include "scoring/curve.h"
#include "scoring/skeleton_file.h"

namespace zskel::scoring {

/// The part of a true limb next to one of its free ends.
struct TipRegion {
    std::string name;
    std::vector<Piece> pieces;
};

/// One for every free end, in the order of the limbs: the last `share` of the limb's length, and
/// straight on for `radii_beyond` of the last node's radius. A limb with two free ends has two,
/// told apart in their names.
std::vector<TipRegion> tip_regions(const Truth& truth, double share, double radii_beyond);

/// The limbs without a free end; those of a single node too.
std::vector<Limb> inner_limbs(const Truth& truth);

/// A largest one-to-one assignment.
/// @param choices  for each item on the left the items on the right that it may get, best first.
/// @return         of each item on the right, the one on the left; kNone where it is free.
std::vector<std::uint32_t> assign(const std::vector<std::vector<std::uint32_t>>& choices,
                                  std::size_t right_count);

}  // namespace zskel::scoring
