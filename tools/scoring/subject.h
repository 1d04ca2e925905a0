#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/mesh.h"
#include "zskel/mesh/solid.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/graph.h"
#include "zskel/visibility/surface_query.h"

namespace zskel::scoring {

/// A model that skeletons are scored against. Its lengths and places are in *diagonals*: the model
/// centred, the diagonal of its bounding box 1.
class Subject {
  public:
    /// @throws InputError for a mesh without area.
    explicit Subject(const Mesh& mesh);
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    /// All solids; cavities face their void, so that normals point out of the material.
    const Surface& surface() const { return surface_; }
    /// One a solid; cavities are part of theirs.
    std::size_t expected_components() const { return expected_components_; }
    /// Whether every solid is; only then one side of the surface leads to the other through it
    /// alone.
    bool is_closed() const { return is_closed_; }
    /// Handles of the surface; none where it has no genus (edges with three faces, one-sided).
    std::optional<std::size_t> expected_cycles() const { return expected_cycles_; }

    /// Winding number above one half, which also tells for surfaces with openings. O(triangles).
    bool is_inside(const DVec3& point) const;
    /// Whether no surface lies between the two.
    bool is_free(const DVec3& from, const DVec3& to) const;
    /// Distance to the nearest surface point: the inscribed radius, where the point is inside.
    double distance_at(const DVec3& point) const;
    /// Distance to the first surface along a unit direction; none on a miss.
    std::optional<double> ray(const DVec3& from, const DVec3& direction) const;

    /// A skeleton from model space, positions and radii in diagonals.
    SkeletonGraph in_diagonals(const SkeletonGraph& graph) const;

  private:
    Subject(const Mesh& mesh, const std::vector<Solid>& solids);

    Surface surface_;
    SurfaceQuery query_;
    std::size_t expected_components_;
    bool is_closed_;
    std::optional<std::size_t> expected_cycles_;
};

}  // namespace zskel::scoring
