#include "zskel/io/gltf_builder.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/io/little_endian.h"
#include "zskel/io/packing.h"

namespace zskel {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

std::vector<float> flat(const std::vector<DVec3>& points) {
    std::vector<float> values;
    values.reserve(points.size() * 3);
    for (const DVec3& p : points)
        for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(p[axis]));
    return values;
}

}  // namespace

std::size_t GltfBuilder::add_positions(const std::vector<DVec3>& points) {
    const std::vector<float> values = flat(points);
    const std::size_t accessor = add_floats(values, "VEC3", points.size());
    Json low = Json::array();
    Json high = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float least = values[axis];
        float most = values[axis];
        for (std::size_t i = axis; i < values.size(); i += 3) {
            least = std::min(least, values[i]);
            most = std::max(most, values[i]);
        }
        low.push_back(least);
        high.push_back(most);
    }
    accessors_[accessor]["min"] = low;
    accessors_[accessor]["max"] = high;
    return accessor;
}

std::size_t GltfBuilder::add_directions(const std::vector<DVec3>& directions) {
    return add_floats(flat(directions), "VEC3", directions.size());
}

std::size_t GltfBuilder::add_scalars(const std::vector<float>& values) {
    return add_floats(values, "SCALAR", values.size());
}

std::size_t GltfBuilder::add_indices(const std::vector<std::uint32_t>& values) {
    const std::size_t begin = bytes_.size();
    for (const std::uint32_t value : values) append_little_endian(bytes_, value);
    return add_accessor(begin, BufferTarget::IndexData, ComponentType::Uint32, "SCALAR",
                        values.size());
}

std::size_t GltfBuilder::add_joints(const std::vector<std::array<std::uint16_t, 4>>& joints) {
    const std::size_t begin = bytes_.size();
    for (const std::array<std::uint16_t, 4>& four : joints) {
        append_little_endian(bytes_, four[0] | static_cast<std::uint32_t>(four[1]) << 16);
        append_little_endian(bytes_, four[2] | static_cast<std::uint32_t>(four[3]) << 16);
    }
    return add_accessor(begin, BufferTarget::VertexData, ComponentType::Uint16, "VEC4",
                        joints.size());
}

std::size_t GltfBuilder::add_weights(const std::vector<std::array<float, 4>>& weights) {
    std::vector<float> values;
    for (const std::array<float, 4>& four : weights)
        values.insert(values.end(), four.begin(), four.end());
    return add_floats(values, "VEC4", weights.size());
}

std::size_t GltfBuilder::add_matrices(const std::vector<glm::dmat4>& matrices) {
    std::vector<float> values;
    for (const glm::dmat4& m : matrices) {
        for (int k = 0; k < 16; ++k) values.push_back(static_cast<float>(m[k / 4][k % 4]));
    }
    return add_floats(values, "MAT4", matrices.size(), std::nullopt);
}

std::size_t GltfBuilder::add_times(const std::vector<double>& seconds) {
    const std::vector<float> values(seconds.begin(), seconds.end());
    const std::size_t accessor = add_floats(values, "SCALAR", values.size(), std::nullopt);
    accessors_[accessor]["min"] = {*std::min_element(values.begin(), values.end())};
    accessors_[accessor]["max"] = {*std::max_element(values.begin(), values.end())};
    return accessor;
}

std::size_t GltfBuilder::add_places(const std::vector<DVec3>& places) {
    return add_floats(flat(places), "VEC3", places.size(), std::nullopt);
}

std::size_t GltfBuilder::add_turns(const std::vector<glm::dquat>& turns) {
    std::vector<float> values;
    for (const glm::dquat& q : turns) {
        for (const double part : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(part));
    }
    return add_floats(values, "VEC4", turns.size(), std::nullopt);
}

std::string GltfBuilder::finish(Json document, const std::string& origin,
                                GltfContainer container) const {
    document["asset"] = {{"version", "2.0"}, {"generator", origin}};
    document["scene"] = 0;
    if (!bytes_.empty()) {
        document["accessors"] = accessors_;
        document["bufferViews"] = views_;
        Json buffer{{"byteLength", bytes_.size()}};
        if (container == GltfContainer::Json)
            buffer["uri"] = "data:application/octet-stream;base64," + base64(bytes_);
        document["buffers"] = {buffer};
    }
    return container == GltfContainer::Json ? document.dump() + "\n" : glb(document.dump());
}

std::size_t GltfBuilder::add_floats(const std::vector<float>& values, const char* type,
                                    std::size_t count, std::optional<BufferTarget> target) {
    const std::size_t begin = bytes_.size();
    for (const float value : values) append_little_endian(bytes_, value);
    return add_accessor(begin, target, ComponentType::Float32, type, count);
}

std::size_t GltfBuilder::add_accessor(std::size_t begin, std::optional<BufferTarget> target,
                                      ComponentType component, const char* type,
                                      std::size_t count) {
    Json view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}};
    if (target) view["target"] = static_cast<int>(*target);
    views_.push_back(std::move(view));
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", static_cast<int>(component)},
                          {"count", count},
                          {"type", type}});
    return accessors_.size() - 1;
}

// A header and two chunks, each filled up to a multiple of four bytes; all our values are.
std::string GltfBuilder::glb(std::string json) const {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string out;
    append_little_endian(out, kGlbMagic);
    append_little_endian(out, std::uint32_t{2});
    if (json.size() + bytes_.size() > std::numeric_limits<std::uint32_t>::max() - 64)
        throw InputError("a GLB file cannot hold more than 4 GiB");
    const std::size_t bin_size = bytes_.empty() ? 0 : 8 + bytes_.size();
    append_little_endian(out, static_cast<std::uint32_t>(12 + 8 + json.size() + bin_size));
    append_little_endian(out, static_cast<std::uint32_t>(json.size()));
    append_little_endian(out, kJsonChunk);
    out += json;
    if (bytes_.empty()) return out;
    append_little_endian(out, static_cast<std::uint32_t>(bytes_.size()));
    append_little_endian(out, kBinChunk);
    return out + bytes_;
}

}  // namespace zskel
