// Visibility by rays: the reference that the Z-buffer is measured against. Embree's packets of 16
// for speed; and the plain form, every ray against every triangle (Moeller and Trumbore 1997).
#include "zskel/visibility/ray_source.h"

#include <cmath>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/visibility/embree_scene.h"

namespace zskel {
namespace {

class EmbreeSource : public VisibilitySource {
  public:
    EmbreeSource(const Surface& solid, Directions directions)
        : VisibilitySource(solid, std::move(directions)), scene_(solid) {
        for (const DVec3& d : this->directions().unit) floats_.emplace_back(d);
    }

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        maps.resize(eyes.size(), directions().size());
        parallel_for(eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t at = i * maps.directions;
                cast_eye(eyes[i], &maps.distance[at], &maps.id[at]);
            }
        });
    }

  private:
    static constexpr std::size_t kPacket = 16;

    void cast_eye(const Vec3& eye, float* distance, std::uint32_t* id) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (std::size_t first = 0; first < floats_.size(); first += kPacket) {
            const std::size_t count = std::min(kPacket, floats_.size() - first);
            RTCRayHit16 rays{};
            alignas(64) int valid[kPacket];
            for (std::size_t k = 0; k < kPacket; ++k) {
                const Vec3& d = floats_[std::min(first + k, floats_.size() - 1)];
                valid[k] = k < count ? -1 : 0;
                rays.ray.org_x[k] = eye.x;
                rays.ray.org_y[k] = eye.y;
                rays.ray.org_z[k] = eye.z;
                rays.ray.dir_x[k] = d.x;
                rays.ray.dir_y[k] = d.y;
                rays.ray.dir_z[k] = d.z;
                rays.ray.tfar[k] = kInfinity;
                rays.ray.mask[k] = 0xFFFFFFFFu;
                rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            }
            rtcIntersect16(valid, scene_.get(), &context, &rays);
            for (std::size_t k = 0; k < count; ++k) {
                const bool hit = rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
                distance[first + k] = hit ? rays.ray.tfar[k] : kInfinity;
                id[first + k] = hit ? rays.hit.primID[k] : kNone;
            }
        }
    }

    EmbreeScene scene_;
    std::vector<Vec3> floats_;
};

class BruteForceSource : public VisibilitySource {
  public:
    using VisibilitySource::VisibilitySource;

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        maps.resize(eyes.size(), directions().size());
        parallel_for(eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t k = 0; k < maps.directions; ++k) {
                    const std::size_t at = i * maps.directions + k;
                    cast_ray(eyes[i], Vec3(directions().unit[k]), maps.distance[at], maps.id[at]);
                }
            }
        });
    }

  private:
    void cast_ray(const Vec3& eye, const Vec3& direction, float& distance,
                  std::uint32_t& id) const {
        distance = kInfinity;
        id = kNone;
        const Surface& surface = solid();
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
            const Triangle& tri = surface.triangles[t];
            const Vec3& corner = surface.positions[tri.x];
            const Vec3 side1 = surface.positions[tri.y] - corner;
            const Vec3 side2 = surface.positions[tri.z] - corner;
            const Vec3 across = glm::cross(direction, side2);
            const float determinant = glm::dot(side1, across);
            if (determinant == 0.0f) continue;
            const Vec3 from_corner = eye - corner;
            const float u = glm::dot(from_corner, across) / determinant;
            if (u < 0.0f || u > 1.0f) continue;
            const Vec3 turned = glm::cross(from_corner, side1);
            const float v = glm::dot(direction, turned) / determinant;
            if (v < 0.0f || u + v > 1.0f) continue;
            const float along = glm::dot(side2, turned) / determinant;
            if (along > 0.0f && along < distance) {
                distance = along;
                id = t;
            }
        }
    }
};

}  // namespace

std::unique_ptr<VisibilitySource> make_ray_source(const Surface& solid, Directions directions,
                                                  RayMethod method) {
    if (method == RayMethod::BruteForce) {
        return std::make_unique<BruteForceSource>(solid, std::move(directions));
    }
    return std::make_unique<EmbreeSource>(solid, std::move(directions));
}

}  // namespace zskel
