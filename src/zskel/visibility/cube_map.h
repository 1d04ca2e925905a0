#pragma once

#include <array>
#include <cstddef>

#include "zskel/core/types.h"
#include "zskel/visibility/directions.h"

namespace zskel {

/// The smallest and largest cube maps, in texels along a face.
inline constexpr int kMinFacePx = 4;
inline constexpr int kMaxFacePx = 1024;

/// Near plane of the Z-buffers' cube maps, world units: surface nearer to an eye than this is not
/// seen.
inline constexpr float kNearPlane = 1e-6f;

/// What a backend takes unless told otherwise: 5 times closer than the paper's 197 rays.
inline constexpr int kDefaultFacePx = 16;

/// The largest that a GPU reduces to records where they are: what fits the shared memory that every
/// driver has (32 KB).
inline constexpr int kMostReducedFacePx = 16;

/// @throws UsageError unless kMinFacePx <= face_px <= kMaxFacePx.
void check_face_px(int face_px);

/// A cube face: `right` x `up` = -`forward`, so that a picture of it keeps the winding of
/// triangles. Faces are in GL's order, +X -X +Y -Y +Z -Z, with GL's own axes for each.
struct CubeFace {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
};
const std::array<CubeFace, 6>& cube_faces();

/// World space to each face's own (right, up, forward), as shaders take it.
std::array<glm::mat3, 6> faces_from_world();

/// Where a texel stands in a map: faces one after the other, rows upward, columns to the right.
struct Texel {
    int face;
    int column;
    int row;
};
Texel texel_at(std::size_t index, int face_px);
std::size_t texel_index(const Texel& texel, int face_px);

/// Direction through the centre ((i + 1/2) / n) of a texel, with axial length 1: distance_radial is
/// its length times depth_axial.
DVec3 texel_direction(const Texel& texel, int face_px);

/// Exact solid angle of a texel in steradians (arctangent form); a map's texels sum to 4 pi.
double texel_solid_angle(const Texel& texel, int face_px);

/// The same as a share of the sphere: the weight of a sample.
double texel_share(const Texel& texel, int face_px);

/// The texel that a direction goes through; on an edge, the lower face, column and row.
Texel texel_of_direction(const DVec3& direction, int face_px);

/// The 6 n^2 texels of a cube map as sample directions.
/// @throws UsageError unless kMinFacePx <= face_px <= kMaxFacePx.
Directions cube_directions(int face_px);

}  // namespace zskel
