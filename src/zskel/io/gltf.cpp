// glTF 2.0: one mesh, of lines with the radius as attribute _RADIUS, or of triangles. Its numbers
// are 32-bit, as the format asks. Without edges the nodes are points; an accessor may not be empty.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include <nlohmann/json.hpp>

#include "zskel/io/format_io.h"
#include "zskel/io/tubes.h"

namespace zskel {
namespace {

using Json = nlohmann::ordered_json;

// Numbers that the format gives to its terms.
enum class ComponentType { Uint32 = 5125, Float32 = 5126 };
enum class BufferTarget { VertexData = 34962, IndexData = 34963 };
enum class PrimitiveMode { Points = 0, Lines = 1, Triangles = 4 };

constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

/// Appends a value's bytes, the lowest first.
void append(std::string& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return out;
}

class GltfBuilder {
  public:
    /// Each adds an accessor with its own view of the buffer, and gives its number.
    std::size_t add_positions(const std::vector<DVec3>& points) {
        std::vector<float> values;
        for (const DVec3& p : points)
            for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(p[axis]));
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
    std::size_t add_scalars(const std::vector<float>& values) {
        return add_floats(values, "SCALAR", values.size());
    }
    std::size_t add_indices(const std::vector<std::uint32_t>& values) {
        const std::size_t begin = bytes_.size();
        for (const std::uint32_t value : values) append(bytes_, value);
        return add_accessor(begin, BufferTarget::IndexData, ComponentType::Uint32, "SCALAR",
                            values.size());
    }

    /// The file, of one mesh with one primitive, or of none.
    std::string finish(const Json& primitive, const std::string& origin, GltfContainer container) {
        Json document{{"asset", {{"version", "2.0"}, {"generator", origin}}}, {"scene", 0}};
        if (primitive.empty()) {
            document["scenes"] = Json::array({Json::object()});
        } else {
            document["scenes"] = {{{"nodes", {0}}}};
            document["nodes"] = {{{"mesh", 0}, {"name", "skeleton"}}};
            document["meshes"] = {{{"primitives", {primitive}}}};
            document["accessors"] = accessors_;
            document["bufferViews"] = views_;
            Json buffer{{"byteLength", bytes_.size()}};
            if (container == GltfContainer::Json)
                buffer["uri"] = "data:application/octet-stream;base64," + base64(bytes_);
            document["buffers"] = {buffer};
        }
        return container == GltfContainer::Json ? document.dump() + "\n" : glb(document.dump());
    }

  private:
    std::size_t add_floats(const std::vector<float>& values, const char* type, std::size_t count) {
        const std::size_t begin = bytes_.size();
        for (const float value : values) append(bytes_, std::bit_cast<std::uint32_t>(value));
        return add_accessor(begin, BufferTarget::VertexData, ComponentType::Float32, type, count);
    }
    std::size_t add_accessor(std::size_t begin, BufferTarget target, ComponentType component,
                             const char* type, std::size_t count) {
        views_.push_back({{"buffer", 0},
                          {"byteOffset", begin},
                          {"byteLength", bytes_.size() - begin},
                          {"target", static_cast<int>(target)}});
        accessors_.push_back({{"bufferView", views_.size() - 1},
                              {"componentType", static_cast<int>(component)},
                              {"count", count},
                              {"type", type}});
        return accessors_.size() - 1;
    }
    /// A header and two chunks, each filled up to a multiple of four bytes; all our values are.
    std::string glb(std::string json) const {
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string out;
        append(out, kGlbMagic);
        append(out, 2);
        const std::size_t bin_size = bytes_.empty() ? 0 : 8 + bytes_.size();
        append(out, static_cast<std::uint32_t>(12 + 8 + json.size() + bin_size));
        append(out, static_cast<std::uint32_t>(json.size()));
        append(out, kJsonChunk);
        out += json;
        if (bytes_.empty()) return out;
        append(out, static_cast<std::uint32_t>(bytes_.size()));
        append(out, kBinChunk);
        return out + bytes_;
    }

    std::string bytes_;
    Json accessors_ = Json::array();
    Json views_ = Json::array();
};

}  // namespace

std::string write_gltf_lines(const SkeletonGraph& graph, const std::string& origin,
                             GltfContainer container) {
    GltfBuilder builder;
    if (graph.nodes.empty()) return builder.finish({}, origin, container);
    std::vector<DVec3> places;
    std::vector<float> radii;
    for (const SkeletonGraph::Node& node : graph.nodes) {
        places.push_back(node.position);
        radii.push_back(static_cast<float>(node.radius));
    }
    std::vector<std::uint32_t> ends;
    for (const SkeletonGraph::Edge& edge : graph.edges)
        ends.insert(ends.end(), {edge.source, edge.target});
    Json primitive{
        {"attributes",
         {{"POSITION", builder.add_positions(places)}, {"_RADIUS", builder.add_scalars(radii)}}},
        {"mode", static_cast<int>(ends.empty() ? PrimitiveMode::Points : PrimitiveMode::Lines)}};
    if (!ends.empty()) primitive["indices"] = builder.add_indices(ends);
    return builder.finish(primitive, origin, container);
}

std::string write_gltf_tubes(const SkeletonGraph& graph, const std::string& origin,
                             GltfContainer container) {
    GltfBuilder builder;
    const TubeSurface tubes = tube_surface(graph);
    if (tubes.triangles.empty()) return builder.finish({}, origin, container);
    std::vector<std::uint32_t> corners;
    for (const Triangle& t : tubes.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
    const Json primitive{{"attributes", {{"POSITION", builder.add_positions(tubes.positions)}}},
                         {"indices", builder.add_indices(corners)},
                         {"mode", static_cast<int>(PrimitiveMode::Triangles)}};
    return builder.finish(primitive, origin, container);
}

}  // namespace zskel
