#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/mesh.h"

namespace zskel {

/// Something that had to be changed or is not as a solid should be; goes to the log and the output.
struct Repair {
    std::string what;
    std::size_t count = 0;
};

/// Triangles over places: what repairs work on, and how it corresponds to the input. Model space.
struct WeldedMesh {
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> input_triangle;  ///< of every triangle; kNone: put in by a repair
    std::vector<std::uint32_t> place;   ///< of every input vertex; kNone when no triangle uses it
    std::vector<std::uint32_t> vertex;  ///< of every place: an input vertex there, or at
                                        ///< an end of the edge that the place cuts
};

/// Adds to `repairs` unless `count` is 0.
void note(std::vector<Repair>& repairs, std::string what, std::size_t count);

/// Gives equal positions one place and leaves out triangles that repeat one.
WeldedMesh weld_equal(const Mesh& mesh, std::vector<Repair>& repairs);

/// Gives places new numbers, drops triangles that then repeat one, and places that none uses.
/// @param number  of every place; any numbers, those that are equal become one place, at the
///                position of the first.
/// @return        the triangles dropped.
std::size_t renumber(WeldedMesh& mesh, const std::vector<std::uint32_t>& number);

/// Lets go of places that no triangle uses.
void keep_used_places(WeldedMesh& mesh);

/// Leaves out every triangle for which `drop` is set. Places stay.
void drop_triangles(WeldedMesh& mesh, const std::vector<bool>& drop);

/// Leaves out triangles with the same corners as an earlier one.
void drop_duplicates(WeldedMesh& mesh, std::vector<Repair>& repairs);

/// Length of the bounding box's diagonal.
double diagonal_of(const WeldedMesh& mesh);

}  // namespace zskel
