#pragma once

#include <string_view>

#include "zskel/mesh/read_mesh.h"

namespace zskel {

// One reader a format: the file's bytes in, the mesh out; `name` stands in messages.
// All throw InputError, and LimitError where options.max_faces is passed; none sets the hash.

/// Wavefront OBJ: polygons of `v`; what belongs to texture, normals and curves is skipped.
Mesh read_obj(std::string_view bytes, std::string_view name, const ReadOptions& options);

/// Geomview OFF in text form: [ST][C][N]OFF with colours, normals and comments skipped.
Mesh read_off(std::string_view bytes, std::string_view name, const ReadOptions& options);

/// Stanford PLY 1.0 in all three encodings; elements and properties that are not used are skipped.
Mesh read_ply(std::string_view bytes, std::string_view name, const ReadOptions& options);

/// STL, ascii or binary; corners at equal positions become one vertex, numbered as first seen.
Mesh read_stl(std::string_view bytes, std::string_view name, const ReadOptions& options);

/// Bezier patches (.bpt): the number of patches; of each its two degrees, and its control points
/// row by row. Divided as `tessellate` does.
Mesh read_bpt(std::string_view bytes, std::string_view name, const ReadOptions& options);

/// Surfaces by formula (JSON), divided as `tessellate` does:
///   {"surfaces": [
///     {"type": "bezier", "patches": [[[[x, y, z], ...], ...], ...]},        rows of control points
///     {"type": "nurbs", "degrees": [3, 2], "knots": [[...], [...]],        along rows, across them
///      "points": [[[x, y, z, weight], ...], ...]},                         rows of control points
///     {"type": "superquadric", "radii": [1, 1, 2], "exponents": [1, 0.3],
///      "center": [0, 0, 0], "turn": 30, "axis": [1, 0, 0]}]}               from center on:
///      optional
Mesh read_surfaces(std::string_view bytes, std::string_view name, const ReadOptions& options);

/// True when the length is the one that a binary STL's own count of facets asks for.
bool is_binary_stl(std::string_view bytes);

}  // namespace zskel
