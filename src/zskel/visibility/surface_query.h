#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "zskel/mesh/surface.h"

namespace zskel {

/// Exact questions about a surface, prepared once; world space. Thread-safe.
class SurfaceQuery {
  public:
    /// `surface` must outlive the query.
    explicit SurfaceQuery(const Surface& surface);
    ~SurfaceQuery();

    struct Nearest {
        float distance = kInfinity;
        Vec3 point{0.0f};
        std::uint32_t triangle = kNone;
    };
    /// The surface point nearest to `point`: the inscribed radius, where `point` is inside.
    /// @param within  a distance known to hold one, up to rounding; less is looked at then.
    Nearest nearest(const Vec3& point, float within = kInfinity) const;

    struct Hit {
        float fraction = 0.0f;  ///< of the way from `from` to `to`
        std::uint32_t triangle = kNone;
    };
    /// The first triangle that the segment meets; nothing when it is free.
    std::optional<Hit> first_hit(const Vec3& from, const Vec3& to) const;

    /// Whether the segment meets no triangle: faster than `first_hit`.
    bool sees(const Vec3& from, const Vec3& to) const;

    /// The same of the segments between pairs of `points`, 1 or 0 each; fastest where neighbours in
    /// the list are neighbours in space.
    void see(std::span<const Vec3> points, std::span<const glm::uvec2> pairs,
             std::span<std::uint8_t> is_free) const;

    /// More than any solid's width, world units.
    static constexpr float kFarthest = 4.0f;

    /// From a point on in a unit direction to the surface, world units; `farthest` when there is
    /// none so near.
    float free_way(const Vec3& from, const Vec3& direction, float farthest = kFarthest) const;

    /// The same in many directions from one point, several at a time.
    void free_ways(const Vec3& from, std::span<const Vec3> directions, std::span<float> ways) const;

    /// Winding number about `point`, exact also for open surfaces. O(triangles).
    double winding_number(const Vec3& point) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace zskel
