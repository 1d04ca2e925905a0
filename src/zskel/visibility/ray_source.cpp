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
        : VisibilitySource(solid, std::move(directions)), scene_(solid, EmbreeScene::Shape::Fast) {
        for (const DVec3& d : this->directions().unit) floats_.emplace_back(d);
    }

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        maps.resize(eyes.size(), directions().size());
        parallel_for(eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                float* distances = &maps.distance[i * maps.directions];
                std::uint32_t* ids = &maps.id[i * maps.directions];
                cast_rays(scene_, eyes[i], floats_, RTC_INTERSECT_CONTEXT_FLAG_COHERENT,
                          [&](std::size_t k, float distance, std::uint32_t triangle) {
                              distances[k] = distance;
                              ids[k] = triangle;
                          });
            }
        });
    }

  private:
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
