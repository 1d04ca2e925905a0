#pragma once

#include <string>
#include <string_view>

#include "zskel/rebuild/visibility_maps.h"

namespace zskel {

/// Visibility maps as a file of bytes, little-endian throughout:
///   "zskelmap", then 32-bit version (1), texels along a face, number of nodes, 64-bit size of the
///   packed rest; packed by zlib: of each node the eye (3 x 64-bit), the solid (32-bit), the least
///   and the largest axial depth (2 x 32-bit), and its 6 n^2 texels, 16 bits each: 0 for a miss,
///   else 1 + 65534 log(depth / least) / log(largest / least), rounded. Texels are differences from
///   the one before, low bytes first, then high bytes. A depth comes back within 1 part in 10,000
///   where the largest is up to 10^5 times the least.
std::string write_visibility_maps(const VisibilityMaps& maps);

/// @throws InputError that names the file and the byte or node: sizes are checked against each
/// other before anything of that size is taken.
VisibilityMaps read_visibility_maps(std::string_view bytes, const std::string& name);

/// Whether a file's first bytes are those of visibility maps.
bool is_visibility_maps(std::string_view bytes);

}  // namespace zskel
