#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace zskel {

/// For maps from the cells of a lattice.
struct LatticeHash {
    std::size_t operator()(const glm::i64vec3& cell) const {
        return static_cast<std::size_t>(cell.x * 73856093 ^ cell.y * 19349663 ^ cell.z * 83492791);
    }
};

}  // namespace zskel
