#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/io/format_io.h"

namespace zskel {

/// Gathers the binary buffer of a glTF 2.0 file, and writes the file round it. Its numbers are
/// 32-bit, as the format asks; no accessor may be empty.
class GltfBuilder {
  public:
    using Json = nlohmann::ordered_json;
    enum class PrimitiveMode { Points = 0, Lines = 1, Triangles = 4 };

    /// Each adds an accessor with its own view of the buffer, and gives its number.
    std::size_t add_positions(const std::vector<DVec3>& points);  ///< with their bounds; not empty
    std::size_t add_directions(const std::vector<DVec3>& directions);
    std::size_t add_scalars(const std::vector<float>& values);
    std::size_t add_indices(const std::vector<std::uint32_t>& values);
    std::size_t add_joints(const std::vector<std::array<std::uint16_t, 4>>& joints);
    std::size_t add_weights(const std::vector<std::array<float, 4>>& weights);
    std::size_t add_matrices(const std::vector<glm::dmat4>& matrices);
    std::size_t add_times(const std::vector<double>& seconds);    ///< with their bounds
    std::size_t add_places(const std::vector<DVec3>& places);     ///< of keys, as are
    std::size_t add_turns(const std::vector<glm::dquat>& turns);  ///< these

    /// The file.
    /// @throws InputError when a binary file would be larger than its 32-bit sizes can say.
    /// @param document  scenes, nodes, meshes and skins; what describes the buffer is added here.
    std::string finish(Json document, const std::string& origin, GltfContainer container) const;

  private:
    enum class ComponentType { Uint16 = 5123, Uint32 = 5125, Float32 = 5126 };
    enum class BufferTarget { VertexData = 34962, IndexData = 34963 };

    std::size_t add_floats(const std::vector<float>& values, const char* type, std::size_t count,
                           std::optional<BufferTarget> target = BufferTarget::VertexData);
    std::size_t add_accessor(std::size_t begin, std::optional<BufferTarget> target,
                             ComponentType component, const char* type, std::size_t count);
    std::string glb(std::string json) const;

    std::string bytes_;
    Json accessors_ = Json::array();
    Json views_ = Json::array();
};

}  // namespace zskel
