#include "zskel/io/range_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "zskel/core/assert.h"
#include "zskel/core/parallel.h"
#include "zskel/visibility/cube_map.h"

namespace zskel {
namespace {

constexpr int kSamples = 3;         // along each side of a pixel
constexpr float kBright = 0.94f;    // of the nearest texel
constexpr float kDark = 0.12f;      // of the farthest
constexpr double kMarkRad = 0.055;  // the disc, and the ring's outer edge
constexpr double kRingRad = 0.035;  // the ring's inner edge
constexpr double kRimRad = 0.016;   // white about both
constexpr double kSeam = 0.006;     // half a line between faces, of a face's half width
constexpr Vec3 kPaper(1.0f);

// A face as it lies in the cross; columns from the left, rows from the top.
struct Cell {
    int column;
    int row;
    DVec3 right;
    DVec3 up;
    DVec3 forward;
};
const std::array<Cell, 6>& cells() {
    static const std::array<Cell, 6> all{{
        {0, 1, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}},
        {1, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {2, 1, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
        {3, 1, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {1, 0, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {1, 2, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    }};
    return all;
}

class Painter {
  public:
    Painter(int face_px, std::span<const float> distance, const DVec3& force)
        : face_px_(face_px), distance_(distance) {
        const double strength = glm::length(force);
        if (strength > 0.0) toward_ = force / strength;
        for (const float r : distance) {
            if (!std::isfinite(r)) continue;
            nearest_ = std::min(nearest_, r);
            farthest_ = std::max(farthest_, r);
        }
    }

    // x and y in faces, from the cross's upper left corner.
    Vec3 color(double x, double y) const {
        for (const Cell& cell : cells()) {
            const double u = 2.0 * (x - cell.column) - 1.0;
            const double v = 1.0 - 2.0 * (y - cell.row);
            const double border = std::max(std::abs(u), std::abs(v));
            if (border > 1.0) continue;
            const DVec3 direction = cell.forward + u * cell.right + v * cell.up;
            if (const std::optional<Vec3> mark = mark_color(direction)) return *mark;
            return border > 1.0 - kSeam ? kPaper : texel_color(direction);
        }
        return kPaper;
    }

  private:
    std::optional<Vec3> mark_color(const DVec3& direction) const {
        if (toward_ == DVec3(0.0)) return std::nullopt;
        const double cosine = std::clamp(glm::dot(glm::normalize(direction), toward_), -1.0, 1.0);
        const double angle = std::acos(cosine);
        const double opposite = std::acos(-cosine);
        if (angle < kMarkRad || (opposite < kMarkRad && opposite > kRingRad)) return kForceColor;
        const bool is_rim = angle < kMarkRad + kRimRad ||
                            (opposite < kMarkRad + kRimRad && opposite > kRingRad - kRimRad);
        return is_rim ? std::optional(kPaper) : std::nullopt;
    }

    Vec3 texel_color(const DVec3& direction) const {
        const float r = distance_[texel_index(texel_of_direction(direction, face_px_), face_px_)];
        if (!std::isfinite(r)) return kMissColor;
        const float span = std::log(farthest_ / nearest_);
        const float far_share = span > 1e-6f ? std::log(r / nearest_) / span : 0.0f;
        return Vec3(glm::mix(kBright, kDark, far_share));
    }

    int face_px_;
    std::span<const float> distance_;
    DVec3 toward_{0.0};
    float nearest_ = kInfinity;
    float farthest_ = 0.0f;
};

}  // namespace

Image range_image(int face_px, std::span<const float> distance, const DVec3& force, int width_px) {
    ZSKEL_ASSERT(distance.size() == 6 * static_cast<std::size_t>(face_px) * face_px, "a whole map");
    const int height_px = width_px * 3 / 4;
    Image image = make_image(width_px, height_px, 3, 255);
    const Painter painter(face_px, distance, force);
    const double face_width = width_px / 4.0;
    parallel_for(static_cast<std::size_t>(height_px), 16, [&](std::size_t begin, std::size_t end) {
        std::size_t out = begin * static_cast<std::size_t>(width_px) * 3;
        for (std::size_t row = begin; row < end; ++row) {
            for (int column = 0; column < width_px; ++column) {
                Vec3 sum(0.0f);
                for (int i = 0; i < kSamples * kSamples; ++i) {
                    const int right = i % kSamples;
                    const int down = i / kSamples;
                    const double x = column + (right + 0.5) / kSamples;
                    const double y = static_cast<double>(row) + (down + 0.5) / kSamples;
                    sum += painter.color(x / face_width, y / face_width);
                }
                const Vec3 mean = sum * (255.0f / (kSamples * kSamples));
                for (int c = 0; c < 3; ++c)
                    image.pixels[out++] = static_cast<std::uint8_t>(std::lround(mean[c]));
            }
        }
    });
    return image;
}

}  // namespace zskel
