#include "zskel/skeleton/openings.h"

#include <algorithm>
#include <cmath>

#include "zskel/core/edges.h"

namespace zskel {
namespace {

constexpr float kLeastWidth = 0.5f;  // of an opening, in radii of the branch that ends at it
constexpr float kFarthest = 4.0f;  // of an end from the middle of its opening, in the larger radius
constexpr float kInside = 1e-3f;  // how near to the rim's middle its node is, as a share of the way
constexpr float kSpacing = 0.02f;  // of nodes on the way, world units

// The solid without its caps.
Surface walls_of(const Solid& solid) {
    std::vector<bool> is_cap(solid.surface.triangles.size(), false);
    for (const std::uint32_t t : solid.caps) is_cap[t] = true;
    Surface walls;
    walls.positions = solid.surface.positions;
    for (std::size_t t = 0; t < is_cap.size(); ++t) {
        if (is_cap[t]) continue;
        walls.triangles.push_back(solid.surface.triangles[t]);
        walls.triangle_normals.push_back(solid.surface.triangle_normals[t]);
    }
    return walls;
}

class Runner {
  public:
    Runner(const SurfaceQuery& query, const SurfaceQuery& walls, SolidSkeleton& skeleton)
        : query_(query), walls_(walls), skeleton_(skeleton), degree_(skeleton.nodes.size(), 0) {
        for (const glm::uvec2& edge : skeleton.edges) {
            ++degree_[edge.x];
            ++degree_[edge.y];
        }
    }

    void run_to(const Vec3& middle, float radius) {
        std::uint32_t from = nearest(middle, radius, 1, kFarthest);
        if (from == kNone) from = nearest(middle, radius, kNone, kInfinity);
        if (from == kNone) return;
        const Vec3 start = skeleton_.nodes[from];
        const Vec3 end = glm::mix(middle, start, kInside);
        const auto steps = static_cast<int>(std::ceil(glm::distance(start, end) / kSpacing));
        for (int k = 1; k <= steps; ++k) {
            const Vec3 place =
                glm::mix(start, end, static_cast<float>(k) / static_cast<float>(steps));
            const auto added = static_cast<std::uint32_t>(skeleton_.nodes.size());
            skeleton_.nodes.push_back(place);
            skeleton_.radii.push_back(walls_.nearest(place).distance);
            skeleton_.edges.emplace_back(from, added);
            ++degree_[from];
            degree_.push_back(1);
            from = added;
        }
        skeleton_.open_ends.push_back(from);
        degree_[from] = kNone;  // no other opening's end
    }

  private:
    std::uint32_t nearest(const Vec3& middle, float radius, std::uint32_t most_edges,
                          float farthest) const {
        std::uint32_t best = kNone;
        float least = kInfinity;
        for (std::uint32_t n = 0; n < degree_.size(); ++n) {
            if (degree_[n] > most_edges || degree_[n] == kNone) continue;
            const Vec3& from = skeleton_.nodes[n];
            const float own = skeleton_.radii[n];
            const float away = glm::distance(from, middle);
            if (radius < kLeastWidth * own || away > farthest * std::max(own, radius)) continue;
            if (away >= least || !query_.sees(from, glm::mix(middle, from, kInside))) continue;
            best = n;
            least = away;
        }
        return best;
    }

    const SurfaceQuery& query_;
    const SurfaceQuery& walls_;
    SolidSkeleton& skeleton_;
    std::vector<std::uint32_t> degree_;
};

}  // namespace

void run_to_openings(const Solid& solid, const SurfaceQuery& query, SolidSkeleton& skeleton) {
    const Surface surface = walls_of(solid);
    const SurfaceQuery walls(surface);
    for (std::size_t n = 0; n < skeleton.nodes.size(); ++n)
        skeleton.radii[n] = walls.nearest(skeleton.nodes[n]).distance;
    Runner runner(query, walls, skeleton);
    const Similarity& to_world = solid.surface.world_from_model;
    for (const Opening& opening : solid.openings) {
        if (!opening.is_end) continue;
        runner.run_to(to_world.to_world(opening.center),
                      static_cast<float>(opening.radius * to_world.scale));
    }
    std::sort(skeleton.edges.begin(), skeleton.edges.end(), edge_before);
}

}  // namespace zskel
