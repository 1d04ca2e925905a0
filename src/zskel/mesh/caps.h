#pragma once

#include <vector>

#include "zskel/mesh/welded_mesh.h"

namespace zskel {

struct Orientation;

/// A boundary loop that was closed.
struct Opening {
    DVec3 center{0.0};    ///< of its rim, weighted by length
    double radius = 0.0;  ///< of a disc as large as its cap
    std::uint32_t component = 0;
    bool is_end = false;  ///< the walls at its rim run across it, as a tube's do where it ends; a
                          ///< hole in a side has them round it in its own plane
};

/// Closes boundary loops with triangles between the places on their rims, the least in area
/// (Barequet and Sharir 1995), so that what is behind is seen as closed; they are appended, with
/// kNone for an input triangle. Left open are components that no orientation fits, that have
/// crowded edges, or that are sheets: whose capped volume is thin beside the caps; a warning goes
/// to `repairs`.
/// Scraps, parts of less than a thousandth of the area that stay open beside one that is closed,
/// are left out.
/// @param parts  of the mesh; its components that were closed are said to be.
std::vector<Opening> cap_openings(WeldedMesh& mesh, Orientation& parts,
                                  std::vector<Repair>& repairs);

}  // namespace zskel
