#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/mesh.h"

namespace zskel {

/// Triangles that hang together by edges.
struct TopologyComponent {
    std::size_t triangle_count = 0;
    std::size_t vertex_count = 0;    ///< of the half-edge mesh: copies count
    std::size_t boundary_loops = 0;  ///< with a boundary edge; not those of cuts alone
    int euler_characteristic = 0;    ///< vertices - edges + triangles of the half-edge mesh
    bool is_closed = true;           ///< every edge has exactly two triangles
    bool is_manifold = true;         ///< at most two triangles an edge, one fan of them a vertex
    bool is_oriented = true;         ///< neighbours wind the same way, as given
    bool is_orientable = true;       ///< they can be made to
    std::optional<int> genus;  ///< handles; none with non-manifold edges or when not orientable
};

/// How triangles hang together. A half-edge mesh holds two triangles an edge and one fan a vertex,
/// so edges with more, edges without a common orientation and vertices where fans touch are cut
/// open first: a vertex then has several copies.
struct Topology {
    /// In the order of their first triangle.
    std::vector<TopologyComponent> components;
    /// Of every triangle; kNone when a corner repeats: those are left out.
    std::vector<std::uint32_t> component_of_triangle;
    /// Of every triangle: winds against most of those that it hangs together with.
    std::vector<bool> is_turned;
    // Edges, lower vertex first, sorted.
    std::vector<glm::uvec2> boundary_edges;      ///< one triangle
    std::vector<glm::uvec2> non_manifold_edges;  ///< three triangles or more
    std::vector<glm::uvec2> inconsistent_edges;  ///< two triangles that run along it the same way
    /// Where several fans of triangles meet; sorted.
    std::vector<std::uint32_t> non_manifold_vertices;
    /// Vertices round each opening, in the given numbers.
    std::vector<std::vector<std::uint32_t>> boundary_loops;
    /// Of each vertex of the half-edge mesh: the given one.
    std::vector<std::uint32_t> vertex_of_copy;
};

/// Finds out how triangles hang together; equal positions under two numbers are two vertices.
/// @param triangles  indices below vertex_count.
Topology find_topology(std::size_t vertex_count, std::span<const Triangle> triangles);
Topology find_topology(const Mesh& mesh);

}  // namespace zskel
