#pragma once

#include <span>
#include <vector>

#include "zskel/visibility/surface_query.h"

namespace zskel {

/// How far places on the surface lie from a skeleton while it grows, and stick out of the balls
/// along it. A ball counts for the places that its centre sees: a tail beside a leg is not in the
/// leg's balls.
class Coverage {
  public:
    /// @param places   on the surface.
    /// @param inside   a point just inside each of them.
    Coverage(const SurfaceQuery& query, std::vector<Vec3> places, std::vector<Vec3> inside);

    /// Adds the balls along a path, their radius going evenly from the first end's to the last's.
    void add(std::span<const Vec3> path, float first_radius, float last_radius);

    /// From a place to the nearest ball that sees it; negative inside, infinite when none does.
    float beyond(std::size_t place) const { return beyond_[place]; }

    /// From a place to the nearest point of a path that sees it; infinite when none does.
    float distance(std::size_t place) const { return distance_[place]; }

    const std::vector<Vec3>& places() const { return places_; }

  private:
    void add_segment(std::size_t place, const Vec3& a, const Vec3& b, float radius_a,
                     float radius_b);

    const SurfaceQuery& query_;
    std::vector<Vec3> places_;
    std::vector<Vec3> inside_;
    std::vector<float> beyond_;
    std::vector<float> distance_;
};

}  // namespace zskel
