#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/mesh.h"

namespace zskel {

/// Triangles that hang together by edges.
struct ComponentReport {
    std::size_t triangles = 0;
    std::size_t boundary_loops = 0;
    bool is_closed = false;
    bool is_manifold = false;
    bool is_oriented = false;  ///< neighbours wind the same way, as given
    bool is_orientable = false;
    std::optional<int> genus;  ///< none with non-manifold edges or when not orientable
    std::optional<double>
        volume;  ///< model units cubed, negative when inside out; none unless closed
    Box box;
};

/// Something about a mesh that is not as a solid's boundary should be.
struct Defect {
    std::string name;  ///< snake_case, fixed: "degenerate_triangles", ...
    std::size_t count = 0;
    std::string example;  ///< the first such element, in the input's numbers counted from 0
    std::string action;   ///< what extraction does about it
};

/// What is known about a mesh before anything is extracted from it. Counts that concern shape or
/// connection are of what extraction works on: equal positions welded, then degenerate and
/// duplicate triangles left out.
struct MeshReport {
    std::string name;
    std::uint64_t hash = 0;  ///< of the file's bytes
    std::size_t vertices = 0;
    std::size_t faces = 0;  ///< polygons of the input
    std::size_t triangles = 0;
    std::size_t coincident_vertices = 0;  ///< used, at the place of an earlier used one
    std::size_t unreferenced_vertices = 0;
    std::size_t degenerate_triangles = 0;  ///< a corner repeats
    std::size_t flat_triangles = 0;        ///< three corners on a line
    std::size_t duplicate_triangles = 0;   ///< same corners as an earlier one, in any order
    std::optional<std::size_t>
        crossing_triangles;  ///< that pass through another; none when too many pairs are near
    std::size_t boundary_edges = 0;
    std::size_t boundary_loops = 0;
    std::size_t non_manifold_edges = 0;     ///< three triangles or more
    std::size_t non_manifold_vertices = 0;  ///< several fans of triangles meet
    std::size_t inconsistent_edges = 0;     ///< two triangles that run along it the same way
    std::vector<ComponentReport> components;
    std::optional<int> genus;           ///< sum over components; none when one has none
    std::optional<double> volume;       ///< sum over closed components; none without one
    Box box;                            ///< of what triangles use; 0 to 0 without any
    std::vector<Defect> defects;        ///< only those found; empty for a proper solid
    std::vector<std::string> warnings;  ///< from reading
};

/// Looks at a mesh and changes nothing. @throws nothing on any mesh with valid indices.
MeshReport check_mesh(const Mesh& mesh);

}  // namespace zskel
