#pragma once

#include <string>
#include <vector>

namespace zskel {

/// A tree of which things are near which, by average linkage, as a picture (SVG): names to the
/// right, joins as far to the left as their parts are apart.
/// @param distances  symmetric, one row a name; finite.
/// @throws UsageError for more names than a picture holds (4,000).
std::string dendrogram_svg(const std::vector<std::string>& names,
                           const std::vector<std::vector<double>>& distances);

}  // namespace zskel
