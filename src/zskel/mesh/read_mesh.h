#pragma once

#include <span>
#include <string>
#include <string_view>

#include "zskel/mesh/mesh.h"

namespace zskel {

enum class MeshFormat { Obj, Off, Ply, Stl };

/// Reads a mesh file: OBJ, OFF (COFF, NOFF, ... too), PLY (ascii, binary) or STL (ascii, binary;
/// equal corners welded). The form follows the extension; without a known one, the content.
/// @param path  a file, or "-" for standard input.
/// @return      the mesh in model space; polygons triangulated; the input's vertex numbers kept.
/// @throws InputError  naming file, line or byte, and value, on anything malformed: nothing is
/// guessed.
Mesh read_mesh(const std::string& path);

/// The same from bytes already in memory; `name` stands in messages.
Mesh parse_mesh(std::span<const std::byte> bytes, MeshFormat format, const std::string& name);

}  // namespace zskel
