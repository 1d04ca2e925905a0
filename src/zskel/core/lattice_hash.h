#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace zskel {

/// The cell of a lattice of cubes that a point lies in.
inline glm::i64vec3 cell_of(const glm::dvec3& point, double size) {
    return glm::i64vec3(glm::floor(point / size));
}

/// For maps from such cells.
struct LatticeHash {
    std::size_t operator()(const glm::i64vec3& cell) const {
        const glm::u64vec3 c(cell);  // wraps round where signed numbers would overflow
        return c.x * 73856093 ^ c.y * 19349663 ^ c.z * 83492791;
    }
};

}  // namespace zskel
