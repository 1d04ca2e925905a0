#include "zskel/mesh/level_set.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/lattice_hash.h"
#include "zskel/mesh/tetrahedra.h"

namespace zskel {
namespace {

// A crossing stays so far from an edge's ends, in shares of it, that no triangle is without area.
constexpr double kOffCorner = 0.02;

constexpr int kAcross = kLevelSetBlock + 1;  // corners of a block's cells
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

int place_in(const glm::ivec3& p) {
    return (p.x * kLevelSetBlock + p.y) * kLevelSetBlock + p.z;
}

class Mesher {
  public:
    explicit Mesher(std::span<const LevelSetBlock> blocks) : blocks_(blocks) {
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            number_.emplace(blocks[b].at, b);
            low_ = glm::min(low_, blocks[b].at);
        }
    }

    LevelSetMesh run() {
        for (const LevelSetBlock& block : blocks_) {
            if (!gather(block)) continue;
            for (int cell = 0; cell < kLevelSetBlock * kLevelSetBlock * kLevelSetBlock; ++cell)
                cut_cell({cell / (kLevelSetBlock * kLevelSetBlock),
                          cell / kLevelSetBlock % kLevelSetBlock, cell % kLevelSetBlock});
        }
        return std::move(mesh_);
    }

  private:
    static std::size_t corner_in(const glm::ivec3& p) {
        const int corner = (p.x * kAcross + p.y) * kAcross + p.z;
        return static_cast<std::size_t>(corner);
    }

    // The values at the corners of a block's cells, of the blocks after it too; false when the sign
    // is the same everywhere.
    bool gather(const LevelSetBlock& block) {
        first_ = block.at * kLevelSetBlock;
        std::array<const LevelSetBlock*, 8> around{};
        for (int n = 0; n < 8; ++n) {
            const auto known = number_.find(block.at + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
            if (known != number_.end())
                around[static_cast<std::size_t>(n)] = &blocks_[known->second];
        }
        bool has_inside = false;
        bool has_outside = false;
        for (int c = 0; c < kAcross * kAcross * kAcross; ++c) {
            const glm::ivec3 p(c / (kAcross * kAcross), c / kAcross % kAcross, c % kAcross);
            const glm::ivec3 over = p / kLevelSetBlock;
            const LevelSetBlock* from =
                around[static_cast<std::size_t>(over.x | over.y << 1 | over.z << 2)];
            float value = kUnknown;
            if (from != nullptr) {
                const auto place = static_cast<std::size_t>(place_in(p - over * kLevelSetBlock));
                value = from->values[from->values.size() == 1 ? 0 : place];
            }
            values_[corner_in(p)] = value;
            has_inside = has_inside || value < 0.0f;
            has_outside = has_outside || value >= 0.0f;
        }
        return has_inside && has_outside;
    }

    void cut_cell(const glm::ivec3& low) {
        int inside = 0;
        int known = 0;
        for (int k = 0; k < 8; ++k) {
            const float value = values_[corner_in(low + glm::ivec3(k & 1, k >> 1 & 1, k >> 2))];
            inside += value < 0.0f ? 1 : 0;
            known += value == value ? 1 : 0;
        }
        if (known < 8 || inside == 0 || inside == 8) return;
        for (const auto& tetrahedron : kCellTetrahedra) {
            int corners_inside = 0;
            for (std::size_t k = 0; k < 4; ++k)
                corners_inside |= (values_[corner_in(low + tetrahedron[k])] < 0.0f ? 1 : 0) << k;
            cut_tetrahedron(corners_inside, [&](std::span<const TetrahedronEdge> polygon) {
                std::array<std::uint32_t, 4> v{};
                for (std::size_t k = 0; k < polygon.size(); ++k) {
                    v[k] = crossing(low + tetrahedron[static_cast<std::size_t>(polygon[k].first)],
                                    low + tetrahedron[static_cast<std::size_t>(polygon[k].second)]);
                }
                mesh_.triangles.emplace_back(v[0], v[1], v[2]);
                if (polygon.size() == 4) mesh_.triangles.emplace_back(v[0], v[2], v[3]);
            });
        }
    }

    // A tetrahedron's edge goes up in each axis or stays: its lower corner and the axes name it.
    std::uint32_t crossing(const glm::ivec3& a, const glm::ivec3& b) {
        const glm::ivec3 low = glm::min(a, b);
        const glm::ivec3 axes = glm::max(a, b) - low;
        const glm::i64vec3 place(first_ + low - low_ * kLevelSetBlock);
        const std::uint64_t key = static_cast<std::uint64_t>(place.x) << 43 |
                                  static_cast<std::uint64_t>(place.y) << 23 |
                                  static_cast<std::uint64_t>(place.z) << 3 |
                                  static_cast<std::uint64_t>(axes.x | axes.y << 1 | axes.z << 2);
        const auto [entry, is_new] =
            crossings_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (is_new) {
            const auto va = static_cast<double>(values_[corner_in(low)]);
            const auto vb = static_cast<double>(values_[corner_in(low + axes)]);
            const double share = std::clamp(va / (va - vb), kOffCorner, 1.0 - kOffCorner);
            mesh_.positions.push_back(DVec3(first_ + low) + DVec3(axes) * share);
        }
        return entry->second;
    }

    std::span<const LevelSetBlock> blocks_;
    std::unordered_map<glm::i64vec3, std::size_t, LatticeHash> number_;
    glm::ivec3 low_{std::numeric_limits<int>::max()};
    glm::ivec3 first_{0};  // place of the block at hand
    std::array<float, static_cast<std::size_t>(kAcross* kAcross* kAcross)> values_{};
    std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
    LevelSetMesh mesh_;
};

}  // namespace

LevelSetMesh mesh_level_set(std::span<const LevelSetBlock> blocks) {
    return Mesher(blocks).run();
}

std::size_t drop_parts(LevelSetMesh& mesh,
                       const std::function<bool(std::span<const Triangle> part)>& is_dropped) {
    DisjointSets sets(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        sets.unite(t.x, t.y);
        sets.unite(t.x, t.z);
    }
    std::map<std::uint32_t, std::vector<Triangle>> parts;
    for (const Triangle& t : mesh.triangles) parts[sets.find(t.x)].push_back(t);
    const std::size_t dropped =
        std::erase_if(parts, [&](const auto& part) { return is_dropped(part.second); });
    if (dropped == 0) return 0;
    std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
    std::vector<DVec3> kept;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        if (!parts.contains(sets.find(v))) continue;
        number[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(mesh.positions[v]);
    }
    mesh.positions = std::move(kept);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return number[t.x] == kNone; });
    for (Triangle& t : mesh.triangles) t = {number[t.x], number[t.y], number[t.z]};
    return dropped;
}

}  // namespace zskel
