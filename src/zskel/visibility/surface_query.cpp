// Nearest points and segments through Embree's hierarchy; the closest point of a triangle is found
// by the regions of its barycentric coordinates (Ericson, Real-Time Collision Detection,
// 2005, 5.1.5).
#include "zskel/visibility/surface_query.h"

#include <algorithm>
#include <cmath>

#include "zskel/core/assert.h"
#include "zskel/mesh/winding.h"
#include "zskel/visibility/embree_scene.h"

namespace zskel {
namespace {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const float length2 = glm::dot(ab, ab);
    const float t = length2 > 0.0f ? std::clamp(glm::dot(p - a, ab) / length2, 0.0f, 1.0f) : 0.0f;
    return a + t * ab;
}

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = glm::cross(b - a, c - a);
    const float area2 = glm::dot(normal, normal);
    if (area2 > 0.0f) {
        const float wa = glm::dot(glm::cross(c - b, p - b), normal);
        const float wb = glm::dot(glm::cross(a - c, p - c), normal);
        const float wc = glm::dot(glm::cross(b - a, p - a), normal);
        if (wa >= 0.0f && wb >= 0.0f && wc >= 0.0f)
            return p - normal * (glm::dot(p - a, normal) / area2);
    }
    Vec3 best = nearest_on_segment(p, a, b);
    for (const Vec3& other : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)}) {
        if (glm::distance(p, other) < glm::distance(p, best)) best = other;
    }
    return best;
}

struct NearestSearch {
    const Surface* surface;
    Vec3 point;
    SurfaceQuery::Nearest best;
};

constexpr float kPlaneSlack = 1.0001f;  // for rounding
constexpr float kWithinSlack = 1.001f;

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<NearestSearch*>(arguments->userPtr);
    const std::uint32_t id = arguments->primID;
    const Triangle& t = search.surface->triangles[id];
    const auto& positions = search.surface->positions;
    // A plane that is farther off than the nearest so far holds nothing nearer.
    const float off_plane =
        std::abs(glm::dot(search.point - positions[t.x], search.surface->triangle_normals[id]));
    if (off_plane > kPlaneSlack * search.best.distance) return false;
    const Vec3 found =
        nearest_on_triangle(search.point, positions[t.x], positions[t.y], positions[t.z]);
    const float distance = glm::distance(search.point, found);
    // Ties go to the lowest triangle, whatever order the hierarchy is walked in.
    if (distance > search.best.distance ||
        (distance == search.best.distance && id > search.best.triangle)) {
        return false;
    }
    search.best = {distance, found, id};
    arguments->query->radius = distance;
    return true;
}

// Triangles from which on the quick shape takes no longer over all, a skeleton's queries counted.
constexpr std::size_t kLarge = 100000;
EmbreeScene::Shape shape_for(const Surface& surface) {
    return surface.triangles.size() < kLarge ? EmbreeScene::Shape::Fast : EmbreeScene::Shape::Quick;
}

}  // namespace

struct SurfaceQuery::Impl {
    explicit Impl(const Surface& s) : surface(s), scene(s, shape_for(s)) {}
    const Surface& surface;
    EmbreeScene scene;
};

SurfaceQuery::SurfaceQuery(const Surface& surface) : impl_(std::make_unique<Impl>(surface)) {}
SurfaceQuery::~SurfaceQuery() = default;

SurfaceQuery::Nearest SurfaceQuery::nearest(const Vec3& point, float within) const {
    NearestSearch search{&impl_->surface, point, {}};
    RTCPointQuery query{point.x, point.y, point.z, 0.0f, within * kWithinSlack};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(impl_->scene.get(), &query, &context, visit_triangle, &search);
    return search.best.triangle == kNone && within < kInfinity ? nearest(point) : search.best;
}

std::optional<SurfaceQuery::Hit> SurfaceQuery::first_hit(const Vec3& from, const Vec3& to) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{embree_ray(from, to - from, 1.0f), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{ray.ray.tfar, ray.hit.primID};
}

bool SurfaceQuery::sees(const Vec3& from, const Vec3& to) const {
    return meets_nothing(impl_->scene.get(), embree_ray(from, to - from, 1.0f));
}

void SurfaceQuery::see(std::span<const Vec3> points, std::span<const glm::uvec2> pairs,
                       std::span<std::uint8_t> is_free) const {
    ZSKEL_ASSERT(pairs.size() == is_free.size(), "one answer a pair");
    constexpr std::size_t kPacket = 16;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t first = 0; first < pairs.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, pairs.size() - first);
        RTCRay16 rays{};
        alignas(64) int valid[kPacket];
        for (std::size_t k = 0; k < kPacket; ++k) {
            const glm::uvec2& pair = pairs[std::min(first + k, pairs.size() - 1)];
            valid[k] = k < count ? -1 : 0;
            set_ray(rays, k, points[pair.x], points[pair.y] - points[pair.x], 1.0f);
        }
        rtcOccluded16(valid, impl_->scene.get(), &context, &rays);
        for (std::size_t k = 0; k < count; ++k) is_free[first + k] = rays.tfar[k] >= 0.0f ? 1 : 0;
    }
}

float SurfaceQuery::free_way(const Vec3& from, const Vec3& direction, float farthest) const {
    const auto hit = first_hit(from, from + direction * farthest);
    return hit ? hit->fraction * farthest : farthest;
}

void SurfaceQuery::free_ways(const Vec3& from, std::span<const Vec3> directions,
                             std::span<float> ways) const {
    ZSKEL_ASSERT(directions.size() == ways.size(), "one way a direction");
    cast_rays(impl_->scene, from, directions, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT,
              [&](std::size_t i, float distance, std::uint32_t /*triangle*/) {
                  ways[i] = std::min(distance, kFarthest);
              });
}

double SurfaceQuery::winding_number(const Vec3& point) const {
    return zskel::winding_number(impl_->surface.positions, impl_->surface.triangles, DVec3(point));
}

}  // namespace zskel
