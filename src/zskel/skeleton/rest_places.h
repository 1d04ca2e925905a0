#pragma once

#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "zskel/core/lattice_hash.h"
#include "zskel/core/types.h"

namespace zskel {

/// Where seeds came to rest, each place with its core: the ball of a share of its distance to the
/// surface. What lies well in the core of another is left out, so that places are few however many
/// seeds there are, and looking one up takes as long for many as for few.
class RestPlaces {
  public:
    explicit RestPlaces(double share) : share_(static_cast<float>(share)) {}

    /// @param nearest  distance from there to the surface.
    void add(const Vec3& place, float nearest);

    /// The place in whose core a point lies; of several the nearest, in radii of their cores.
    std::optional<Vec3> find(const Vec3& point) const;

  private:
    struct Core {
        Vec3 center;
        float radius;
    };
    const Core* core_about(const Vec3& point, float within) const;

    using Grid = std::unordered_map<glm::i64vec3, std::vector<Core>, LatticeHash>;

    float share_;
    std::map<int, Grid> grids_;  // by the size of their cells, 2^i: at least a core's diameter
};

}  // namespace zskel
