#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/caps.h"
#include "zskel/mesh/mesh.h"
#include "zskel/mesh/welded_mesh.h"

namespace zskel {

/// Centred, uniformly scaled: `world = (model - center) * scale`.
struct Similarity {
    DVec3 center{0.0};
    double scale = 1.0;

    Vec3 to_world(const DVec3& model) const { return Vec3((model - center) * scale); }
    DVec3 to_model(const Vec3& world) const { return DVec3(world) / scale + center; }
    double length_to_model(double world) const { return world / scale; }
};

/// How world space is scaled.
enum class WorldSize {
    UnitCube,  ///< the longest side of the bounding box is 1, its middle at 0 (the paper's)
    Spread,    ///< the area's root mean square distance from its centroid is kWorldSpread: the same
             ///< however the model is turned, and about a unit cube for the shapes that one meets.
             ///< Each solid has such a space of its own, whatever else the model holds
};
inline constexpr double kWorldSpread = 0.3;

/// The scale by an area's spread. @param otherwise  what is taken where there is no area, or none
/// that can be scaled.
Similarity scale_by_spread(std::span<const DVec3> positions, std::span<const Triangle> triangles,
                           const Similarity& otherwise);

/// Flat buffers of a triangle surface in world space; every triangle has three different corners.
struct Surface {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Vec3>
        triangle_normals;              ///< unit, out of the solid; zero for a triangle without area
    std::vector<Vec3> vertex_normals;  ///< unit, weighted by the angles of the triangles round it
    std::vector<glm::uvec2> edges;     ///< each once, lower vertex first, sorted
    Similarity world_from_model;
};

/// What may be done to a mesh that bounds no solid as it is.
struct RepairOptions {
    bool is_allowed = true;                  ///< false: such a mesh is refused
    double weld_tolerance_diagonals = 1e-5;  ///< see close_cracks
    bool has_caps = false;                   ///< see cap_openings
};

/// A surface made ready from a mesh, and how the two correspond.
struct PreparedSurface {
    Surface surface;
    std::vector<std::uint32_t> surface_vertex;  ///< of every input vertex; kNone when unused
    std::vector<std::uint32_t> input_vertex;    ///< of every vertex: an input vertex at its place,
                                                ///< or near it for those of `put_in`
    std::vector<std::pair<std::uint32_t, DVec3>>
        put_in;  ///< vertices where the input has none, and their places, model space
    std::vector<std::uint32_t> input_triangle;  ///< of every triangle: its number in the mesh;
                                                ///< kNone for those of caps, last
    std::vector<std::uint32_t> component;       ///< of every triangle: parts joined by edges
    std::uint32_t component_count = 0;
    std::vector<bool> component_closed;  ///< every edge has exactly two triangles
    std::vector<bool> component_sheet;   ///< open, and too thin to hold anything if it were capped
    bool fans_are_whole = false;         ///< the triangles at every vertex hang together over edges
    std::vector<DVec3> places;      ///< of every vertex, model space; only where solids are scaled
                                    ///< one by one: WorldSize::Spread, more components than one
    std::vector<Opening> openings;  ///< that caps close
    std::vector<Repair> repairs;
};

/// Makes a mesh ready, a repair a file: equal positions welded, degenerate and duplicate faces
/// dropped (welded_mesh.h), cracks closed (cracks.h), non-manifold edges mended (crowded_edges.h),
/// every component oriented consistently and outward (orient.h), openings capped (caps.h); and
/// scales the whole. What was done, and what could not be mended, is in `repairs`.
/// @throws InputError when no triangle with area is left, or a repair is needed and not allowed.
PreparedSurface prepare_surface(const Mesh& mesh, WorldSize size = WorldSize::UnitCube,
                                const RepairOptions& options = {});

/// The triangles of a prepared surface, those of caps among them, between input vertices.
std::vector<Triangle> input_triangles(const PreparedSurface& prepared);

/// Fills the normals from positions and triangles.
void derive_normals(Surface& surface);

/// Fills the edges from the triangles.
void derive_edges(Surface& surface);

}  // namespace zskel
