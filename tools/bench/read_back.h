#pragma once

#include "zskel/visibility/visibility_source.h"

namespace zskel::bench {

/// Another source's records by the long way: whole maps, read back and reduced here.
class ReadBack : public VisibilitySource {
  public:
    explicit ReadBack(VisibilitySource& source)
        : VisibilitySource(source.solid(), source.directions()), source_(source) {}

    void render(std::span<const Vec3> eyes, MapBatch& maps) override { source_.render(eyes, maps); }

  private:
    VisibilitySource& source_;
};

}  // namespace zskel::bench
