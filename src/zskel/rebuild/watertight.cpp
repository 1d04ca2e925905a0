#include "zskel/rebuild/watertight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "zskel/core/error.h"
#include "zskel/core/lattice_hash.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/level_set.h"
#include "zskel/mesh/signed_volume.h"
#include "zskel/mesh/winding.h"

namespace zskel {
namespace {

constexpr int kBlock = kLevelSetBlock;
constexpr std::size_t kBlockVoxels = kBlock * kBlock * kBlock;
constexpr double kMostVoxelsAsked = 4096.0;
constexpr double kLeastVoid = 8.0;  // voxels that a void must have

// Where the sampling grid stands: voxel v is at low + v * side.
struct Lattice {
    DVec3 low{0.0};
    double side = 0.0;
    DVec3 place(const DVec3& voxel) const { return low + voxel * side; }
};

// Values are voxels to the surface.
struct Sampled {
    LevelSetBlock block;
    bool has_surface = false;  // or may have: not farther outside or inside than its samples
};

constexpr auto kFar = static_cast<float>(kBlock);

Sampled sample_block(const Recall& recall, const Lattice& lattice, const glm::ivec3& at) {
    const DVec3 first(at * kBlock);
    const double half = 0.5 * kBlock;
    const DVec3 middle = lattice.place(first + half);
    const std::vector<std::uint32_t> among = recall.maps_about(middle, half * lattice.side);
    if (among.empty()) return {{at, {kFar}}, false};
    // Farther inside than its samples lie apart: nothing of the surface in between.
    const double apart = half * lattice.side;
    double least = kInfinity;
    for (int corner = 0; corner < 27 && least > apart; ++corner) {
        const DVec3 step(corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1);
        least = std::min(least, recall.inside(middle + apart * step, among));
    }
    if (least > apart) return {{at, {-kFar}}, false};
    Sampled out{{at, {}}, false};
    out.block.values.reserve(kBlockVoxels);
    for (int x = 0; x < kBlock; ++x) {
        for (int y = 0; y < kBlock; ++y) {
            for (int z = 0; z < kBlock; ++z) {
                const double inside = recall.inside(lattice.place(first + DVec3(x, y, z)), among);
                out.has_surface = out.has_surface || inside > 0.0;
                out.block.values.push_back(
                    std::clamp(static_cast<float>(-inside / lattice.side), -kFar, kFar));
            }
        }
    }
    return out;
}

// From the blocks that hold surfels on, wherever a block has surface on to those beside it.
std::vector<LevelSetBlock> sample_blocks(const Recall& recall, const Lattice& lattice,
                                         const std::vector<Surfel>& surfels) {
    std::unordered_set<glm::i64vec3, LatticeHash> known;
    std::vector<glm::ivec3> next;
    const auto want = [&](const glm::ivec3& at) {
        if (known.emplace(at).second) next.push_back(at);
    };
    for (const Surfel& s : surfels)
        want(glm::ivec3(glm::floor((s.position - lattice.low) / (lattice.side * kBlock))));
    std::vector<LevelSetBlock> blocks;
    while (!next.empty()) {
        const std::vector<glm::ivec3> wanted = std::exchange(next, {});
        std::vector<Sampled> sampled(wanted.size());
        parallel_for(wanted.size(), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                sampled[i] = sample_block(recall, lattice, wanted[i]);
        });
        for (auto& [block, has_surface] : sampled) {
            if (has_surface) {
                for (int n = 0; n < 27; ++n)
                    want(block.at + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            }
            blocks.push_back(std::move(block));
        }
    }
    return blocks;
}

// What no node can have meant: a part without a node in it, since every node sees from the inside,
// or a void of few voxels, where sightings were at odds.
bool is_speck(const LevelSetMesh& mesh, const std::vector<Vec3>& places,
              std::span<const Triangle> part, const Lattice& lattice, const VisibilityMaps& maps) {
    const double volume = signed_volume(mesh.positions, part);
    if (volume <= 0.0) return volume >= -kLeastVoid;
    Box box;
    for (const Triangle& t : part) {
        for (int k = 0; k < 3; ++k) box.add(mesh.positions[t[k]]);
    }
    return std::none_of(maps.nodes.begin(), maps.nodes.end(), [&](const NodeMap& node) {
        const DVec3 eye = (node.eye - lattice.low) / lattice.side;
        return box.holds(eye) && winding_number(places, part, eye) > 0.5;
    });
}

RebuiltMesh mesh_of(const std::vector<LevelSetBlock>& blocks, const Lattice& lattice,
                    const VisibilityMaps& maps) {
    LevelSetMesh mesh = mesh_level_set(blocks);
    const std::vector<Vec3> places(mesh.positions.begin(), mesh.positions.end());
    drop_parts(mesh, [&](std::span<const Triangle> part) {
        return is_speck(mesh, places, part, lattice, maps);
    });
    RebuiltMesh out;
    out.voxel = lattice.side;
    for (const DVec3& p : mesh.positions) out.positions.push_back(lattice.place(p));
    out.triangles = std::move(mesh.triangles);
    return out;
}

// The radius that a twentieth of the maps fall below: of the thinnest parts.
double thin_radius(const VisibilityMaps& maps) {
    std::vector<double> radii;
    for (const NodeMap& node : maps.nodes) {
        radii.push_back(*std::min_element(node.distance.begin(), node.distance.end()));
    }
    const auto place = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 20);
    std::nth_element(radii.begin(), place, radii.end());
    return *place;
}

}  // namespace

RebuiltMesh rebuild_surface(const VisibilityMaps& maps, const RebuildOptions& options) {
    const Recall recall(maps);
    const std::vector<Surfel> all = recall.surfels();
    if (all.empty()) throw InputError("no map saw any surface");
    Lattice lattice;
    Box box;
    for (const Surfel& s : all) box.add(s.position);
    lattice.low = box.low;
    const double longest = box.longest();
    lattice.side =
        options.voxel_model > 0.0
            ? options.voxel_model
            : std::clamp(0.5 * thin_radius(maps), longest / kMostVoxels, longest / kFewestVoxels);
    if (longest > lattice.side * kMostVoxelsAsked) {
        throw UsageError(
            fmt::format("a voxel of {} is too small: the whole is {} long, which may "
                        "be at most {} voxels",
                        lattice.side, longest, kMostVoxelsAsked));
    }
    return mesh_of(sample_blocks(recall, lattice, all), lattice, maps);
}

}  // namespace zskel
