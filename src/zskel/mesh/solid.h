#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/surface.h"

namespace zskel {

/// One outer shell with the cavities inside it: what an eye within it can see. An open part is a
/// solid of its own.
struct Solid {
    Surface surface;  ///< its own vertices and triangles; cavities face their void
    std::vector<std::uint32_t> triangle;  ///< of each of its triangles: the number in the whole
    std::vector<std::uint32_t>
        vertex;                       ///< of each of its vertices: the number in the whole surface
    std::vector<Opening> openings;    ///< that caps close, model space
    std::vector<std::uint32_t> caps;  ///< its triangles that are none of the input's
    std::uint32_t cavity_count = 0;
    bool is_closed = false;  ///< caps counted in
    bool is_sheet = false;   ///< open, and too thin to hold anything
};

/// Groups the components of a surface into solids by nesting. Where a surface touches itself in a
/// vertex, its solid has a vertex for each fan of triangles there. Closed components inside an even
/// number of others are outer shells; those inside an odd number are cavities of the nearest shell
/// round them. A component counts as inside another when all of up to 16 sample vertices have a
/// winding number above one half. Work: (closed components whose boxes nest) x triangles.
std::vector<Solid> split_solids(const PreparedSurface& prepared);

}  // namespace zskel
