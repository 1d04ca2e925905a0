#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/rebuild/visibility_maps.h"
#include "zskel/visibility/cube_map.h"

namespace zskel {

/// What one map knows of a place: the plane of the surface that it saw in that direction.
struct Sighting {
    double inside = 0.0;     ///< how far the place lies before that plane; below 0 behind it
    double footprint = 0.0;  ///< width of a texel there: how much that can be wrong by
    DVec3 outward{0.0};      ///< the plane's normal, unit
    bool is_jump = false;    ///< depths jump there: a wall across the way at the nearest of them
};

/// One node's map, made ready for questions. On a face of a cube map the inverse of the axial depth
/// is affine over a plane, so what is interpolated between four texels is the plane that they see;
/// where the four see different planes that meet in a crease, the plane on the place's side of it.
class RecallMap {
  public:
    RecallMap(const NodeMap& node, int face_px);

    /// Texels that missed count as seen at the nearest distance: the ball about the node is free.
    Sighting look_at(const DVec3& place) const;

    const DVec3& eye() const { return eye_; }
    double farthest() const { return farthest_; }  ///< that it saw

  private:
    // What four texels about a crease see, each by itself; a plane p holds the places x with
    // dot(p, x - eye) = 1.
    struct Crease {
        std::array<Vec3, 4> planes;
        bool is_convex = false;  // the nearest plane is the wall; else the farthest
    };

    float texel(int face, int column, int row) const;
    float& texel(int face, int column, int row);
    std::size_t quad(int face, int column, int row) const;  // of four texels, by the first
    void fill_border();
    Vec3 plane_of(const Texel& at) const;
    void find_creases();
    std::optional<Crease> crease_in(const Texel& first, std::span<const Vec3> planes) const;
    const Vec3* beside_crease(std::size_t quad, const DVec3& direction, double farthest) const;

    DVec3 eye_;
    int face_px_;
    double farthest_ = 0.0;
    std::vector<float> inverse_depth_;  // axial; each face with a border of one texel round it
    std::vector<Crease> creases_;
    std::vector<std::uint32_t> crease_of_;  // each quad's, or kNone
};

/// A point of the surface as a node saw it.
struct Surfel {
    DVec3 position{0.0};
    DVec3 normal{0.0};     ///< outward, unit
    double spacing = 0.0;  ///< width of its texel there
};

/// Of the surfels in one cube of side `cell` the one that was seen closest.
std::vector<Surfel> merge_surfels(const std::vector<Surfel>& surfels, double cell);

/// The inside of the solids as the maps of their nodes tell it: the union of what each sees, and no
/// mesh.
class Recall {
  public:
    explicit Recall(const VisibilityMaps& maps);

    const std::vector<RecallMap>& maps() const { return maps_; }

    /// How far inside a place is: above 0 within, below 0 outside, and near the surface about the
    /// distance to it. A place is inside when some node surely sees past it. Where nodes see the
    /// surface near it their planes are averaged, those with the smallest texels counting most.
    /// @param among  numbers of the maps to ask.
    /// @see Curless and Levoy 1996 (weighted signed distances of range images)
    double inside(const DVec3& place, const std::vector<std::uint32_t>& among) const;

    /// The maps that tell of a cube about `middle`: the nearest of those that see something of it.
    std::vector<std::uint32_t> maps_about(const DVec3& middle, double half_side) const;

    /// Every texel's point, in the order of the nodes; none where depths jump beside it.
    std::vector<Surfel> surfels() const;

  private:
    int face_px_;
    std::vector<RecallMap> maps_;
};

}  // namespace zskel
