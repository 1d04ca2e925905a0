#include "zskel/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/core/lattice_hash.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/level_set.h"
#include "zskel/mesh/signed_volume.h"
#include "zskel/mesh/winding_tree.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

constexpr double kVoxels = 160.0;  // along the longest side, unless said otherwise
constexpr double kMostVoxels = 2048.0;
constexpr double kLeastDepth = 1e-3;  // voxels
constexpr double kThinVoid = 2.0;     // voxels
constexpr int kPlaces = kLevelSetBlock * kLevelSetBlock * kLevelSetBlock;

class Sampler {
  public:
    Sampler(const PreparedSurface& prepared, double side)
        : surface_(prepared.surface),
          side_(side),
          low_(box_of(surface_.positions).low),
          query_(surface_),
          winding_(surface_.positions, surface_.triangles) {
        const auto& closed = prepared.component_closed;
        all_closed_ = std::find(closed.begin(), closed.end(), false) == closed.end();
    }

    DVec3 place(const DVec3& lattice) const { return low_ + lattice * side_; }

    // All blocks that hold a corner of a cell with surface in it, and those beside them as long as
    // the sign changes there.
    std::vector<LevelSetBlock> sample() {
        for (const Triangle& t : surface_.triangles) want_about(t);
        std::vector<LevelSetBlock> blocks;
        while (!next_.empty()) {
            const std::vector<glm::ivec3> wanted = std::exchange(next_, {});
            std::vector<LevelSetBlock> sampled(wanted.size());
            parallel_for(wanted.size(), 2, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) sampled[i] = sample_block(wanted[i]);
            });
            for (LevelSetBlock& block : sampled) {
                if (block.values.empty()) continue;
                const auto [least, most] =
                    std::minmax_element(block.values.begin(), block.values.end());
                if (*least < 0.0f && *most >= 0.0f) want_round(block.at);
                blocks.push_back(std::move(block));
            }
        }
        return blocks;
    }

  private:
    void want(const glm::ivec3& at) {
        if (known_.emplace(at).second) next_.push_back(at);
    }
    void want_round(const glm::ivec3& at) {
        for (int n = 0; n < 27; ++n) want(at + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
    }
    void want_about(const Triangle& t) {
        Box box;
        for (int k = 0; k < 3; ++k) box.add((DVec3(surface_.positions[t[k]]) - low_) / side_);
        const glm::ivec3 first(glm::floor((box.low - 1.0) / double(kLevelSetBlock)));
        const glm::ivec3 last(glm::floor((box.high + 1.0) / double(kLevelSetBlock)));
        for (int x = first.x; x <= last.x; ++x) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int z = first.z; z <= last.z; ++z) want({x, y, z});
            }
        }
    }

    // Without values where no surface is near: the box round a long triangle is mostly empty.
    LevelSetBlock sample_block(const glm::ivec3& at) const {
        LevelSetBlock block{at, {}};
        const DVec3 middle = place(DVec3(at * kLevelSetBlock) + 0.5 * (kLevelSetBlock - 1));
        const double reach = 0.5 * std::numbers::sqrt3 * (kLevelSetBlock + 2) * side_;
        if (all_closed_ && static_cast<double>(query_.nearest(Vec3(middle)).distance) > reach)
            return block;
        block.values.reserve(static_cast<std::size_t>(kPlaces));
        bool is_inside = false;
        double last = 0.0;  // distance at the place before, along z
        for (int i = 0; i < kPlaces; ++i) {
            const glm::ivec3 step(i / 64, i / 8 % 8, i % 8);
            const DVec3 p = place(DVec3(at * kLevelSetBlock + step));
            const auto distance = static_cast<double>(query_.nearest(Vec3(p)).distance);
            // Nothing between the two, so that they are on one side; through openings one may slip.
            const bool is_known = all_closed_ && step.z > 0 && last > side_;
            if (!is_known) is_inside = winding_.at(p) > 0.5;
            last = distance;
            // On a surface between two parts too: 0 would count as outside.
            const double depth = std::max(distance, kLeastDepth * side_);
            block.values.push_back(static_cast<float>(is_inside ? -depth : distance));
        }
        return block;
    }

    const Surface& surface_;
    double side_;
    DVec3 low_;
    SurfaceQuery query_;
    WindingTree winding_;
    bool all_closed_ = false;
    std::unordered_set<glm::i64vec3, LatticeHash> known_;
    std::vector<glm::ivec3> next_;
};

// A void so thin that parts meet there but for the sampling.
bool is_thin_void(std::span<const DVec3> positions, std::span<const Triangle> part) {
    const double volume = signed_volume(positions, part);
    double area = 0.0;
    for (const Triangle& t : part) {
        const DVec3& a = positions[t.x];
        area += 0.5 * glm::length(glm::cross(positions[t.y] - a, positions[t.z] - a));
    }
    return volume < 0.0 && -volume < 0.5 * kThinVoid * area;
}

}  // namespace

JoinedMesh join_parts(const Mesh& mesh, const RepairOptions& repair, const JoinOptions& options) {
    const PreparedSurface prepared = prepare_surface(mesh, WorldSize::UnitCube, repair);
    const Similarity& to_world = prepared.surface.world_from_model;
    const double longest = box_of(prepared.surface.positions).longest();
    const double side =
        options.voxel_model > 0.0 ? options.voxel_model * to_world.scale : longest / kVoxels;
    if (longest > side * kMostVoxels) {
        throw UsageError(
            fmt::format("a voxel of {} is too small: the model may be at most {} of "
                        "them long",
                        options.voxel_model, kMostVoxels));
    }
    Sampler sampler(prepared, side);
    LevelSetMesh surface = mesh_level_set(sampler.sample());
    if (surface.triangles.empty())
        throw InputError(fmt::format("{}: no part has an inside to join", mesh.name));
    JoinedMesh out;
    out.voxel_model = to_world.length_to_model(side);
    out.repairs = prepared.repairs;
    out.repairs.push_back(
        {fmt::format("parts joined by their winding number, in voxels of {:.3g}", out.voxel_model),
         prepared.component_count});
    const auto is_dropped = [&](std::span<const Triangle> part) {
        return is_thin_void(surface.positions, part);
    };
    note(out.repairs, "voids between parts filled: thinner than two voxels",
         drop_parts(surface, is_dropped));
    out.mesh.name = mesh.name;
    out.mesh.hash = mesh.hash;
    out.mesh.warnings = mesh.warnings;
    Surface joined;
    for (const DVec3& p : surface.positions) {
        joined.positions.emplace_back(sampler.place(p));
        out.mesh.positions.push_back(to_world.to_model(joined.positions.back()));
    }
    out.mesh.triangles = std::move(surface.triangles);
    out.mesh.face_count = out.mesh.triangles.size();
    joined.triangles = out.mesh.triangles;
    derive_normals(joined);
    const SurfaceQuery query(joined);
    const WindingTree winding(joined.positions, joined.triangles);
    std::atomic<std::size_t> lost = 0;
    out.nearest.resize(mesh.positions.size(), kNone);
    parallel_for(mesh.positions.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            if (prepared.surface_vertex[v] == kNone) continue;
            const Vec3 p = to_world.to_world(mesh.positions[v]);
            const SurfaceQuery::Nearest nearest = query.nearest(p);
            out.nearest[v] = joined.triangles[nearest.triangle].x;
            if (static_cast<double>(nearest.distance) > side && winding.at(DVec3(p)) < 0.5) ++lost;
        }
    });
    note(out.repairs, "vertices lost: of parts thinner than a voxel (--join-voxel)", lost);
    return out;
}

}  // namespace zskel
