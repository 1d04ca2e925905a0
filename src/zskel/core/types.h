#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace zskel {

/// Points and directions: `Vec3` in buffers, `DVec3` in sums and in model space.
using Vec3 = glm::vec3;
using DVec3 = glm::dvec3;
/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = glm::uvec3;

/// "No such element" in arrays of indices.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace zskel
