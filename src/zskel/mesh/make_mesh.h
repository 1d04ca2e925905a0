#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "zskel/mesh/mesh.h"

namespace zskel {

/// A mesh from a caller's arrays, which are copied and need not last. Vertices and triangles keep
/// their numbers; nothing is repaired.
/// @param xyz        3 * vertices coordinates, model space; each finite.
/// @param corners    3 * triangles vertex numbers, from 0; counter-clockwise seen from outside.
/// @param name       what messages call the mesh.
/// @throws InputError naming the first vertex or triangle that is wrong, or when there is no
///         triangle, or more of either than can be numbered.
Mesh make_mesh(const double* xyz, std::size_t vertices, const std::uint32_t* corners,
               std::size_t triangles, std::string_view name = "mesh");
Mesh make_mesh(const float* xyz, std::size_t vertices, const std::uint32_t* corners,
               std::size_t triangles, std::string_view name = "mesh");

}  // namespace zskel
