#include "zskel/visibility/cpu_source.h"

#include <hwy/highway.h>

#include "zskel/core/assert.h"
#include "zskel/core/parallel.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/triangle_clusters.h"
#include "zskel/visibility/zbuffer.h"

namespace zskel {
namespace {

constexpr std::size_t kClusterTriangles = 64;
constexpr std::size_t kGrain = 8;  // eyes at least that share one Z-buffer, one after the other

class CpuSource : public VisibilitySource {
  public:
    CpuSource(const Surface& solid, int face_px)
        : VisibilitySource(solid, cube_directions(face_px)),
          grid_(face_px),
          clusters_(cluster_triangles(solid, kClusterTriangles)) {}

    void look(std::span<const Vec3> eyes, std::span<EyeRecord> records) override {
        ZSKEL_ASSERT(eyes.size() == records.size(), "one record an eye");
        parallel_for(eyes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            ZBuffer buffer(grid_);
            for (std::size_t i = begin; i < end; ++i) {
                draw_zbuffer(clusters_, grid_, eyes[i], buffer);
                records[i] = summarize_zbuffer(solid(), grid_, buffer);
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
};

}  // namespace

std::unique_ptr<VisibilitySource> make_cpu_source(const Surface& solid, int face_px) {
    return std::make_unique<CpuSource>(solid, face_px);
}

std::string cpu_instruction_set() {
    const auto usable = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(usable & -usable);  // the lowest bit is the best
}

}  // namespace zskel
