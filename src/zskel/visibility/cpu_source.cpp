#include "zskel/visibility/cpu_source.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "zskel/core/assert.h"
#include "zskel/core/instruction_set.h"
#include "zskel/core/parallel.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/surface_level.h"
#include "zskel/visibility/triangle_clusters.h"
#include "zskel/visibility/zbuffer.h"

namespace zskel {
namespace {

// The level: its share of the triangles, and how many of its errors an eye must be away from a
// block.
constexpr double kLevelShare = 0.125;
constexpr float kFarErrors = 10.0f;

constexpr std::size_t kGrain = 8;  // eyes at least that share one Z-buffer, one after the other

// The low ten bits of `x`, three apart.
std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | (x << 16)) & 0x030000FFu;
    x = (x | (x << 8)) & 0x0300F00Fu;
    x = (x | (x << 4)) & 0x030C30C3u;
    return (x | (x << 2)) & 0x09249249u;
}

// Along Morton's curve, so that eyes that see the same triangles come one after the other.
std::vector<std::uint32_t> order_in_space(std::span<const Vec3> eyes) {
    constexpr float kWorld = 4.0f;  // what lies beyond shares the outermost cells
    constexpr float kCells = 1023.0f;
    std::vector<std::uint32_t> code;
    code.reserve(eyes.size());
    for (const Vec3& eye : eyes) {
        const Vec3 share = glm::clamp(eye / kWorld + 0.5f, 0.0f, 1.0f) * kCells;
        code.push_back(spread_bits(static_cast<std::uint32_t>(share.x)) |
                       spread_bits(static_cast<std::uint32_t>(share.y)) << 1 |
                       spread_bits(static_cast<std::uint32_t>(share.z)) << 2);
    }
    std::vector<std::uint32_t> order(eyes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(code[a], a) < std::pair(code[b], b);
    });
    return order;
}

class CpuSource : public VisibilitySource {
  public:
    CpuSource(const Surface& solid, int face_px, CpuDetail detail)
        : VisibilitySource(solid, cube_directions(face_px)),
          grid_(face_px),
          clusters_(cluster_triangles(solid)) {
        if (detail == CpuDetail::Exact || solid.triangles.size() < kLevelsFrom) return;
        level_ = coarser_level(solid, kLevelShare);
        if (level_) level_clusters_ = cluster_triangles(level_->surface);
    }

    void look(std::span<const Vec3> eyes, std::span<EyeRecord> records) override {
        ZSKEL_ASSERT(eyes.size() == records.size(), "one record an eye");
        const std::vector<std::uint32_t> order = order_in_space(eyes);
        parallel_for(eyes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            ZBuffer buffer(grid_);
            for (std::size_t i = begin; i < end; ++i) {
                const Vec3& eye = eyes[order[i]];
                const bool is_far =
                    level_ && !is_near(clusters_, eye, kFarErrors * level_->error_world);
                draw_zbuffer(is_far ? level_clusters_ : clusters_, grid_, eye, buffer);
                records[order[i]] =
                    summarize_zbuffer(is_far ? level_->surface : solid(), grid_, buffer);
            }
        });
    }

    void render(std::span<const Vec3> eyes, MapBatch& maps) override {
        maps.resize(eyes.size(), directions().size());
        parallel_for(eyes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            ZBuffer buffer(grid_);
            for (std::size_t i = begin; i < end; ++i) {
                draw_zbuffer(clusters_, grid_, eyes[i], buffer);
                copy(buffer, &maps.distance[i * maps.directions], &maps.id[i * maps.directions]);
            }
        });
    }

  private:
    void copy(const ZBuffer& buffer, float* distance, std::uint32_t* id) const {
        const auto n = static_cast<std::size_t>(grid_.face_px);
        for (std::size_t row = 0; row < 6 * n; ++row) {
            for (std::size_t column = 0; column < n; ++column) {
                const std::size_t at = row * grid_.stride + column;
                const std::size_t shape = row % n * grid_.stride + column;
                const float inverse = buffer.inverse_depth[at] * grid_.inverse_len[shape];
                *distance++ = inverse > 0.0f ? 1.0f / inverse : kInfinity;
                *id++ = buffer.id[at];
            }
        }
    }

    TexelGrid grid_;
    TriangleClusters clusters_;
    std::optional<SurfaceLevel> level_;
    TriangleClusters level_clusters_;
};

}  // namespace

std::unique_ptr<VisibilitySource> make_cpu_source(const Surface& solid, int face_px,
                                                  CpuDetail detail) {
    return std::make_unique<CpuSource>(solid, face_px, detail);
}

std::string cpu_instruction_set() {
    return hwy::TargetName(instruction_set());
}

}  // namespace zskel
