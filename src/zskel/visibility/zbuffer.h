#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "zskel/core/aligned.h"
#include "zskel/visibility/force.h"
#include "zskel/visibility/triangle_clusters.h"

namespace zskel {

/// A cube face's axes: right, up and forward are coordinate axes with a sign.
struct FaceAxes {
    std::array<int, 3> axis;
    std::array<float, 3> sign;
};

/// What depends on the size of the maps alone. Rows are padded to whole blocks; tables are zero
/// there.
struct TexelGrid {
    explicit TexelGrid(int face_px);

    int face_px;
    std::size_t stride;                ///< floats a row
    AlignedVector<float> center;       ///< of every column, and of every row: -1 to 1
    AlignedVector<float> inverse_len;  ///< 1 / |(u, v, 1)|
    AlignedVector<float> weight;       ///< share of the sphere
    std::array<FaceAxes, 6> faces;
};

/// The cube map of one eye: the Z-buffer proper.
struct ZBuffer {
    explicit ZBuffer(const TexelGrid& grid);

    AlignedVector<float> inverse_depth;  ///< 1 / axial depth; 0 where nothing is seen
    AlignedVector<std::uint32_t> id;     ///< what is seen there

    struct Candidate {
        float inverse_near;  ///< 1 / (least axial depth of its box)
        std::uint32_t group;
        std::array<std::uint16_t, 4> rect;  ///< first and last column, first and last row
    };
    std::array<std::vector<Candidate>, 6> candidates;  ///< scratch, for each face
    std::vector<std::uint32_t> order;                  ///< scratch
};

/// Draws everything that `eye` sees, nearest groups first.
void draw_zbuffer(const TriangleClusters& clusters, const TexelGrid& grid, const Vec3& eye,
                  ZBuffer& buffer);

/// `summarize`, in float and by registers.
EyeRecord summarize_zbuffer(const Surface& surface, const TexelGrid& grid, const ZBuffer& buffer);

}  // namespace zskel
