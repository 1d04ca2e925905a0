#include "zskel/mesh/outlook.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "zskel/core/embree.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/bounds.h"

namespace zskel {
namespace {

constexpr std::size_t kPlaces = 64;  // on a group
constexpr int kRays = 32;            // to each side of a place
constexpr float kOffset = 1e-5f;     // of a ray's start from its triangle, in diagonals

class Looker {
  public:
    explicit Looker(const WeldedMesh& mesh)
        : mesh_(mesh), device_(open_embree()), scene_(rtcNewScene(device_.get())) {
        const Box box = box_of(mesh.positions);
        center_ = 0.5 * (box.low + box.high);
        scale_ = 1.0 / box.diagonal();
        // Embree reads 16 bytes at the last vertex.
        positions_.reserve(mesh.positions.size() + 1);
        for (const DVec3& p : mesh.positions) positions_.emplace_back((p - center_) * scale_);
        positions_.emplace_back(0.0f);
        rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   positions_.data(), 0, sizeof(Vec3), mesh.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles.data(), 0, sizeof(Triangle),
                                   mesh.triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_.get(), geometry);
        rtcReleaseGeometry(geometry);
        build_hierarchy(scene_.get(), device_.get());
        for (int i = 0; i < kRays; ++i) {  // evenly over the half sphere about z, by its area
            const float z = (static_cast<float>(i) + 0.5f) / kRays;
            const auto turn = static_cast<float>(i * std::numbers::pi * (3.0 - std::sqrt(5.0)));
            const float across = std::sqrt(1.0f - z * z);
            directions_.emplace_back(across * std::cos(turn), across * std::sin(turn), z);
        }
    }

    Outlook look(std::span<const std::uint32_t> triangles) const {
        double area = 0.0;
        for (const std::uint32_t t : triangles) area += area_of(t);
        Outlook out;
        std::size_t places = 0;
        double passed = 0.0;
        for (const std::uint32_t t : triangles) {
            const double before = std::floor(passed / area * kPlaces + 0.5);
            passed += area_of(t);
            if (!(std::floor(passed / area * kPlaces + 0.5) > before)) continue;
            out.front += free_share(t, 1.0f);
            out.back += free_share(t, -1.0f);
            ++places;
        }
        if (places == 0) return out;
        return {out.front / static_cast<double>(places), out.back / static_cast<double>(places)};
    }

  private:
    Vec3 at(std::uint32_t triangle, int corner) const {
        return positions_[mesh_.triangles[triangle][corner]];
    }
    Vec3 area_vector(std::uint32_t t) const {
        return glm::cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0));
    }
    double area_of(std::uint32_t t) const {
        return static_cast<double>(glm::length(area_vector(t)));
    }

    double free_share(std::uint32_t t, float side) const {
        const Vec3 normal = glm::normalize(area_vector(t)) * side;
        const Vec3 across = std::abs(normal.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
        const Vec3 u = glm::normalize(glm::cross(normal, across));
        const Vec3 v = glm::cross(normal, u);
        const Vec3 from = (at(t, 0) + at(t, 1) + at(t, 2)) / 3.0f + kOffset * normal;
        int free = 0;
        for (const Vec3& d : directions_)
            free += meets_nothing(scene_.get(),
                                  embree_ray(from, d.x * u + d.y * v + d.z * normal, kInfinity))
                        ? 1
                        : 0;
        return static_cast<double>(free) / kRays;
    }

    const WeldedMesh& mesh_;
    DVec3 center_{0.0};
    double scale_ = 1.0;
    std::vector<Vec3> positions_;
    std::vector<Vec3> directions_;
    EmbreeDevice device_;
    EmbreeHierarchy scene_;
};

}  // namespace

std::vector<Outlook> look_out(const WeldedMesh& mesh, const std::vector<std::uint32_t>& group,
                              std::size_t groups) {
    std::vector<std::vector<std::uint32_t>> members(groups);
    for (std::uint32_t t = 0; t < group.size(); ++t) {
        if (group[t] != kNone) members[group[t]].push_back(t);
    }
    const Looker looker(mesh);
    std::vector<Outlook> out(groups);
    parallel_for(groups, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t g = begin; g < end; ++g) out[g] = looker.look(members[g]);
    });
    return out;
}

}  // namespace zskel
