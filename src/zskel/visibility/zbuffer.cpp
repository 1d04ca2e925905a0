#include "zskel/visibility/zbuffer.h"

#include <cmath>
#include <numbers>

#include "zskel/visibility/cube_map.h"

namespace zskel {

TexelGrid::TexelGrid(int px)
    : face_px(px), stride((static_cast<std::size_t>(px) + kBlock - 1) / kBlock * kBlock) {
    const auto n = static_cast<std::size_t>(px);
    center.assign(stride, 0.0f);
    inverse_len.assign(n * stride, 0.0f);
    weight.assign(n * stride, 0.0f);
    for (int row = 0; row < px; ++row) {
        for (int column = 0; column < px; ++column) {
            const Texel texel{0, column, row};
            const std::size_t at =
                static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column);
            inverse_len[at] = static_cast<float>(1.0 / glm::length(texel_direction(texel, px)));
            weight[at] =
                static_cast<float>(texel_solid_angle(texel, px) / (4.0 * std::numbers::pi));
        }
    }
    for (int i = 0; i < px; ++i)
        center[static_cast<std::size_t>(i)] = static_cast<float>((2.0 * i + 1.0) / px - 1.0);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const CubeFace& face = cube_faces()[f];
        const std::array<Vec3, 3> directions{face.right, face.up, face.forward};
        for (std::size_t k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                if (directions[k][axis] == 0.0f) continue;
                faces[f].axis[k] = axis;
                faces[f].sign[k] = directions[k][axis];
            }
        }
    }
}

ZBuffer::ZBuffer(const TexelGrid& grid)
    : inverse_depth(6 * static_cast<std::size_t>(grid.face_px) * grid.stride, 0.0f),
      id(inverse_depth.size(), 0u) {}

}  // namespace zskel
