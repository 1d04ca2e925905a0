#include "zskel/visibility/cube_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "zskel/core/error.h"

namespace zskel {
namespace {

// Texel borders on a face run from -1 to 1.
double border(int i, int face_px) {
    return 2.0 * i / face_px - 1.0;
}

// Solid angle of the rectangle between the face's centre and (u, v).
double corner_angle(double u, double v) {
    return std::atan2(u * v, std::sqrt(u * u + v * v + 1.0));
}

}  // namespace

void check_face_px(int face_px) {
    if (face_px < kMinFacePx || face_px > kMaxFacePx) {
        throw UsageError(fmt::format("a cube face of {} texels: give {} to {}", face_px, kMinFacePx,
                                     kMaxFacePx));
    }
}

const std::array<CubeFace, 6>& cube_faces() {
    static const std::array<CubeFace, 6> faces{{
        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
        {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
    }};
    return faces;
}

std::array<glm::mat3, 6> faces_from_world() {
    std::array<glm::mat3, 6> out{};
    std::transform(cube_faces().begin(), cube_faces().end(), out.begin(), [](const CubeFace& face) {
        return glm::transpose(glm::mat3(face.right, face.up, face.forward));
    });
    return out;
}

Texel texel_at(std::size_t index, int face_px) {
    const auto n = static_cast<std::size_t>(face_px);
    return {static_cast<int>(index / (n * n)), static_cast<int>(index % n),
            static_cast<int>(index / n % n)};
}

std::size_t texel_index(const Texel& texel, int face_px) {
    const auto n = static_cast<std::size_t>(face_px);
    return (static_cast<std::size_t>(texel.face) * n + static_cast<std::size_t>(texel.row)) * n +
           static_cast<std::size_t>(texel.column);
}

DVec3 texel_direction(const Texel& texel, int face_px) {
    const CubeFace& face = cube_faces()[static_cast<std::size_t>(texel.face)];
    const double u = (2.0 * texel.column + 1.0) / face_px - 1.0;
    const double v = (2.0 * texel.row + 1.0) / face_px - 1.0;
    return DVec3(face.forward) + u * DVec3(face.right) + v * DVec3(face.up);
}

double texel_solid_angle(const Texel& texel, int face_px) {
    const double u0 = border(texel.column, face_px);
    const double u1 = border(texel.column + 1, face_px);
    const double v0 = border(texel.row, face_px);
    const double v1 = border(texel.row + 1, face_px);
    return corner_angle(u1, v1) - corner_angle(u0, v1) - corner_angle(u1, v0) +
           corner_angle(u0, v0);
}

double texel_share(const Texel& texel, int face_px) {
    return texel_solid_angle(texel, face_px) / (4.0 * std::numbers::pi);
}

Texel texel_of_direction(const DVec3& direction, int face_px) {
    Texel texel{0, 0, 0};
    double axial = 0.0;
    for (int f = 0; f < 6; ++f) {
        const double along =
            glm::dot(direction, DVec3(cube_faces()[static_cast<std::size_t>(f)].forward));
        if (along > axial) {
            axial = along;
            texel.face = f;
        }
    }
    const CubeFace& face = cube_faces()[static_cast<std::size_t>(texel.face)];
    const auto cell = [&](const Vec3& axis) {
        const double along = glm::dot(direction, DVec3(axis)) / axial;
        return std::clamp(static_cast<int>((along + 1.0) * 0.5 * face_px), 0, face_px - 1);
    };
    texel.column = cell(face.right);
    texel.row = cell(face.up);
    return texel;
}

Directions cube_directions(int face_px) {
    check_face_px(face_px);
    Directions out;
    out.face_px = face_px;
    const std::size_t count =
        6 * static_cast<std::size_t>(face_px) * static_cast<std::size_t>(face_px);
    out.unit.reserve(count);
    out.weight.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Texel texel = texel_at(i, face_px);
        out.unit.push_back(glm::normalize(texel_direction(texel, face_px)));
        out.weight.push_back(texel_share(texel, face_px));
    }
    return out;
}

}  // namespace zskel
