#pragma once

#include <algorithm>
#include <span>

#include "zskel/core/embree.h"
#include "zskel/mesh/surface.h"

namespace zskel {

/// An Embree scene over a surface's triangles (not copied; the surface must outlive it). Private to
/// the ray source and `SurfaceQuery`; robust mode, so that no ray slips through a shared edge.
class EmbreeScene {
  public:
    /// Of many triangles the building costs more than the asking: Quick is built in half the time,
    /// and compact, 25 bytes a triangle less.
    enum class Shape { Fast, Quick };
    EmbreeScene(const Surface& surface, Shape shape);

    RTCScene get() const { return scene_.get(); }

  private:
    EmbreeDevice device_;
    EmbreeHierarchy scene_;
};

/// Fills place `k` of a packet, as `embree_ray` does one ray.
inline void set_ray(RTCRay16& rays, std::size_t k, const Vec3& from, const Vec3& along,
                    float farthest) {
    rays.org_x[k] = from.x;
    rays.org_y[k] = from.y;
    rays.org_z[k] = from.z;
    rays.dir_x[k] = along.x;
    rays.dir_y[k] = along.y;
    rays.dir_z[k] = along.z;
    rays.tfar[k] = farthest;
    rays.mask[k] = 0xFFFFFFFFu;
}

/// Casts rays from one point in unit directions, 16 at a time, and tells `take(ray, distance,
/// triangle)` of each: kInfinity and kNone where nothing is hit.
/// @param coherence  whether 16 rays on end go much the same way.
template <typename Take>
void cast_rays(const EmbreeScene& scene, const Vec3& from, std::span<const Vec3> directions,
               RTCIntersectContextFlags coherence, const Take& take) {
    constexpr std::size_t kPacket = 16;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence;
    for (std::size_t first = 0; first < directions.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, directions.size() - first);
        RTCRayHit16 rays{};
        alignas(64) int valid[kPacket];
        for (std::size_t k = 0; k < kPacket; ++k) {
            valid[k] = k < count ? -1 : 0;
            set_ray(rays.ray, k, from, directions[std::min(first + k, directions.size() - 1)],
                    kInfinity);
            rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, scene.get(), &context, &rays);
        for (std::size_t k = 0; k < count; ++k) {
            const bool hit = rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
            take(first + k, hit ? rays.ray.tfar[k] : kInfinity, hit ? rays.hit.primID[k] : kNone);
        }
    }
}

}  // namespace zskel
