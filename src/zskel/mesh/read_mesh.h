#pragma once

#include <span>
#include <string>
#include <string_view>

#include "zskel/mesh/mesh.h"

namespace zskel {

enum class MeshFormat { Obj, Off, Ply, Stl, Bpt, SurfaceJson };

struct ReadOptions {
    /// Of surfaces by formula: how far their triangles may be from them, in diagonals.
    double chord_error = 0.0005;
    std::size_t max_faces = 0;  ///< triangles; 0: as many as can be numbered
};

/// Reads a mesh file: OBJ, OFF (COFF, NOFF, ... too), PLY (ascii, binary) or STL (ascii, binary;
/// equal corners welded); or surfaces by formula, which become triangles: Bezier patches (BPT), or
/// Bezier patches, NURBS and superquadrics (JSON). The form follows the extension; without a known
/// one, the content.
/// @param path  a file, or "-" for standard input.
/// @return      the mesh in model space; polygons triangulated; the input's vertex numbers kept.
/// @throws InputError  naming file, line or byte, and value, on anything malformed: nothing is
/// guessed. LimitError for more faces than allowed, or than memory holds.
Mesh read_mesh(const std::string& path, const ReadOptions& options = {});

/// The same from bytes already in memory; `name` stands in messages.
Mesh parse_mesh(std::span<const std::byte> bytes, MeshFormat format, const std::string& name,
                const ReadOptions& options = {});

}  // namespace zskel
