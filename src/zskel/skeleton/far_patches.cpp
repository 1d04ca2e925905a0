#include "zskel/skeleton/far_patches.h"

#include <algorithm>
#include <utility>

#include "zskel/skeleton/girth.h"

namespace zskel {
namespace {

constexpr float kFarDepths = 1.6f;  // the surface of a cube and its centre are at most 1.73 apart

}  // namespace

FarPatches::FarPatches(const ClusterContext& context)
    : areas_(context.spread.vertices.size(), 0.0f), neighbours_(areas_.size()) {
    const Surface& surface = context.surface;
    for (const glm::uvec3& t : surface.triangles) {
        const Vec3& a = surface.positions[t.x];
        const Vec3 cross = glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a);
        for (int k = 0; k < 3; ++k)
            areas_[context.spread.seed_of[t[k]]] += glm::length(cross) / 6.0f;
    }
    std::vector<Vec3> inside;
    std::vector<Vec3> normals;
    for (const std::uint32_t v : context.spread.vertices) {
        inside.push_back(context.inner[v]);
        normals.push_back(surface.vertex_normals[v]);
    }
    depths_ = depths_under(context.query, inside, normals);
    for (const glm::uvec2& link : context.links) {
        neighbours_[link.x].push_back(link.y);
        neighbours_[link.y].push_back(link.x);
    }
}

bool FarPatches::is_far(std::uint32_t seed, float distance) const {
    return distance > kFarDepths * depths_[seed];
}

std::vector<FarPatch> FarPatches::find(const Coverage& coverage) const {
    std::vector<FarPatch> patches;
    std::vector<bool> is_left(areas_.size());
    for (std::uint32_t s = 0; s < areas_.size(); ++s) is_left[s] = is_far(s, coverage.distance(s));
    for (std::uint32_t first = 0; first < areas_.size(); ++first) {
        if (!is_left[first]) continue;
        std::vector<std::uint32_t> seeds{first};
        is_left[first] = false;
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            for (const std::uint32_t next : neighbours_[seeds[i]]) {
                if (!is_left[next]) continue;
                is_left[next] = false;
                seeds.push_back(next);
            }
        }
        patches.push_back(measure(std::move(seeds), coverage));
    }
    std::stable_sort(patches.begin(), patches.end(), [](const FarPatch& l, const FarPatch& r) {
        return l.area_depths > r.area_depths;
    });
    return patches;
}

FarPatch FarPatches::measure(std::vector<std::uint32_t> seeds, const Coverage& coverage) const {
    FarPatch patch;
    patch.seeds = std::move(seeds);
    patch.farthest = patch.seeds.front();
    double area = 0.0;
    double depth = 0.0;
    DVec3 centre(0.0);
    for (const std::uint32_t s : patch.seeds) {
        const auto weight = static_cast<double>(areas_[s]);
        area += weight;
        depth += weight * static_cast<double>(depths_[s]);
        centre += DVec3(coverage.places()[s]) * weight;
        if (coverage.distance(s) > coverage.distance(patch.farthest)) patch.farthest = s;
    }
    if (!(area > 0.0) || !(depth > 0.0)) return patch;
    patch.centre = Vec3(centre / area);
    patch.depth = static_cast<float>(depth / area);
    patch.area_depths = area * area * area / (depth * depth);
    return patch;
}

}  // namespace zskel
