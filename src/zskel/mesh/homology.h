#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// The handles of a solid, as integers on the edges of its surface: the classes of walks over the
/// surface in the first homology of the *solid*, where a loop that bounds a disc inside counts for
/// nothing.
struct HandleClasses {
    std::size_t genus = 0;  ///< summed over the solid's shells: independent cycles inside
    std::vector<std::int32_t>
        edge_class;  ///< genus numbers for every edge of Surface::edges, low to high vertex
};

/// A system of 2g loops (a shortest-path tree and a dual tree of greatest loops), the linking
/// numbers of the loops pushed inside with the loops themselves, and from those the classes of all
/// edges.
/// @param inner  a point inside for every vertex, near it.
/// @return       nothing when the surface is not closed, oriented and manifold, or when the linking
/// numbers do
///               not have rank g (surfaces that cut through themselves); `why` then says so.
/// Work: O(n log n) for the loops and O((2g)^2 l^2) for the linking numbers of loops of l edges.
/// @see Erickson and Whittlesey 2005 for the loops; Gauss's integral in van Oosterom and Strackee's
/// form of
///      segment pairs for the linking numbers.
std::optional<HandleClasses> find_handles(const Surface& surface, const std::vector<Vec3>& inner,
                                          std::string& why);

/// Whether integer vectors (each of `width` numbers) can be part of a basis: their maximal minors
/// have greatest common divisor 1.
bool is_primitive(std::vector<std::vector<std::int64_t>> rows);

}  // namespace zskel
