#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace zskel {

/// For maps from the cells of a lattice.
struct LatticeHash {
    std::size_t operator()(const glm::i64vec3& cell) const {
        const glm::u64vec3 c(cell);  // wraps round where signed numbers would overflow
        return c.x * 73856093 ^ c.y * 19349663 ^ c.z * 83492791;
    }
};

}  // namespace zskel
