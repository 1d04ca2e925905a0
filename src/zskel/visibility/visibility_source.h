#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/surface.h"
#include "zskel/visibility/directions.h"
#include "zskel/visibility/force.h"

namespace zskel {

/// Maps of a batch of eyes, one after the other.
struct MapBatch {
    std::size_t directions = 0;  ///< entries a map
    std::vector<float> distance;
    std::vector<std::uint32_t> id;

    void resize(std::size_t eyes, std::size_t directions_per_eye);
    MapView view(std::size_t eye) const;
};

/// The seam between how visibility is found and what is done with it. A source is prepared for one
/// solid: its eyes see that solid's triangles and nothing else. Not thread-safe; calls parallelise
/// inside.
class VisibilitySource {
  public:
    VisibilitySource(const Surface& solid, Directions directions);
    virtual ~VisibilitySource() = default;
    VisibilitySource(const VisibilitySource&) = delete;
    VisibilitySource& operator=(const VisibilitySource&) = delete;

    /// The hot path: a record for each eye (world space).
    /// @throws GlError when a GL pass fails.
    virtual void look(std::span<const Vec3> eyes, std::span<EyeRecord> records);

    /// Whole maps, for dumps, tests and reconstruction. A raster source shows the lowest of
    /// triangles at equal depth; Embree does not say which one it finds.
    /// @throws GlError when a GL pass fails.
    virtual void render(std::span<const Vec3> eyes, MapBatch& maps) = 0;

    const Directions& directions() const { return directions_; }
    const Surface& solid() const { return solid_; }

  private:
    const Surface& solid_;
    Directions directions_;
    MapBatch scratch_;
};

/// One source's eyes and where their records go: as many.
struct Look {
    VisibilitySource* source = nullptr;
    std::span<const Vec3> eyes;
    std::span<EyeRecord> records;
};

}  // namespace zskel
