#include "zskel/io/map_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "zskel/core/error.h"
#include "zskel/io/little_endian.h"
#include "zskel/io/packing.h"
#include "zskel/mesh/byte_cursor.h"
#include "zskel/visibility/cube_map.h"

namespace zskel {
namespace {

constexpr std::string_view kMagic = "zskelmap";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kNodeHeader = 3 * 8 + 4 + 2 * 4;
constexpr double kLastCode = 65534.0;
constexpr std::size_t kMostPacked = 1032;  // bytes that zlib can make of one

std::size_t texel_count(std::size_t face_px) {
    return 6 * face_px * face_px;
}

struct DepthRange {
    float least = 1.0f;
    float largest = 1.0f;
    double log_ratio() const { return std::log(static_cast<double>(largest) / least); }
};

std::vector<float> axial_depths(const NodeMap& node, int face_px) {
    std::vector<float> out(node.distance.size());
    for (std::size_t t = 0; t < out.size(); ++t) {
        out[t] = node.distance[t] /
                 static_cast<float>(glm::length(texel_direction(texel_at(t, face_px), face_px)));
    }
    return out;
}

DepthRange range_of(const std::vector<float>& depths) {
    DepthRange range{std::numeric_limits<float>::max(), 0.0f};
    for (const float d : depths) {
        if (!std::isfinite(d) || d <= 0.0f) continue;
        range.least = std::min(range.least, d);
        range.largest = std::max(range.largest, d);
    }
    return range.largest > 0.0f ? range : DepthRange{};
}

void append_texels(std::string& out, const std::vector<float>& depths, const DepthRange& range) {
    const double log_ratio = range.log_ratio();
    std::string high;
    std::uint16_t before = 0;
    for (const float d : depths) {
        std::uint16_t code = 0;
        if (std::isfinite(d) && d > 0.0f) {
            const double share =
                log_ratio > 0.0 ? std::log(static_cast<double>(d) / range.least) / log_ratio : 0.0;
            code = static_cast<std::uint16_t>(1 + std::lround(share * (kLastCode)));
        }
        const auto step = static_cast<std::uint16_t>(code - before);
        out.push_back(static_cast<char>(step & 0xff));
        high.push_back(static_cast<char>(step >> 8));
        before = code;
    }
    out += high;
}

// What the packed part holds once it is unpacked.
class MapReader {
  public:
    MapReader(std::string_view bytes, int face_px, const std::string& name)
        : bytes_(bytes), name_(name) {
        for (std::size_t t = 0; t < texel_count(static_cast<std::size_t>(face_px)); ++t) {
            lengths_.push_back(
                static_cast<float>(glm::length(texel_direction(texel_at(t, face_px), face_px))));
        }
    }

    NodeMap read(std::size_t number) {
        const std::size_t texels = lengths_.size();
        const std::size_t begin = number * (kNodeHeader + 2 * texels);
        ByteCursor cursor(bytes_, begin, std::endian::little, name_);
        NodeMap node;
        for (int k = 0; k < 3; ++k) node.eye[k] = cursor.read<double>("an eye");
        node.solid = cursor.read<std::uint32_t>("a solid's number");
        const DepthRange range{cursor.read<float>("a depth"), cursor.read<float>("a depth")};
        const bool is_fine = glm::all(glm::lessThan(glm::abs(node.eye), DVec3(kInfinity))) &&
                             range.least > 0.0f && range.largest >= range.least &&
                             std::isfinite(range.largest);
        if (!is_fine) {
            throw InputError(fmt::format(
                "{}: node {}: eye {} {} {}, depths {} to {}: expected finite numbers, depths above "
                "0 and ascending",
                name_, number, node.eye.x, node.eye.y, node.eye.z, range.least, range.largest));
        }
        const std::string_view low = bytes_.substr(begin + kNodeHeader, texels);
        const std::string_view high = bytes_.substr(begin + kNodeHeader + texels, texels);
        const double log_ratio = range.log_ratio();
        std::uint16_t code = 0;
        for (std::size_t t = 0; t < texels; ++t) {
            code = static_cast<std::uint16_t>(code + static_cast<unsigned char>(low[t]) +
                                              256 * static_cast<unsigned char>(high[t]));
            const double depth = range.least * std::exp((code - 1) / kLastCode * log_ratio);
            node.distance.push_back(code == 0 ? kInfinity
                                              : static_cast<float>(depth) * lengths_[t]);
        }
        return node;
    }

  private:
    std::string_view bytes_;
    const std::string& name_;
    std::vector<float> lengths_;
};

}  // namespace

std::string write_visibility_maps(const VisibilityMaps& maps) {
    std::string body;
    for (const NodeMap& node : maps.nodes) {
        const std::vector<float> depths = axial_depths(node, maps.face_px);
        const DepthRange range = range_of(depths);
        for (int k = 0; k < 3; ++k) append_little_endian(body, node.eye[k]);
        append_little_endian(body, node.solid);
        append_little_endian(body, range.least);
        append_little_endian(body, range.largest);
        append_texels(body, depths, range);
    }
    const std::string rest = packed(body);
    std::string out(kMagic);
    append_little_endian(out, kVersion);
    append_little_endian(out, static_cast<std::uint32_t>(maps.face_px));
    append_little_endian(out, static_cast<std::uint32_t>(maps.nodes.size()));
    append_little_endian(out, static_cast<std::uint64_t>(rest.size()));
    return out + rest;
}

bool is_visibility_maps(std::string_view bytes) {
    return bytes.substr(0, kMagic.size()) == kMagic;
}

VisibilityMaps read_visibility_maps(std::string_view bytes, const std::string& name) {
    if (!is_visibility_maps(bytes))
        throw InputError(
            fmt::format("{}: no visibility maps: does not begin with {}", name, kMagic));
    ByteCursor cursor(bytes, kMagic.size(), std::endian::little, name);
    const auto version = cursor.read<std::uint32_t>("the version");
    if (version != kVersion)
        cursor.fail(4, fmt::format("version {}; this program reads version {}", version, kVersion));
    const auto face_px = cursor.read<std::uint32_t>("the texels along a face");
    if (face_px < kMinFacePx || face_px > kMaxFacePx) {
        cursor.fail(4, fmt::format("{} texels along a face; expected {} to {}", face_px, kMinFacePx,
                                   kMaxFacePx));
    }
    const auto count = cursor.read<std::uint32_t>("the number of nodes");
    const auto size = cursor.read<std::uint64_t>("the size of the packed part");
    if (size != cursor.remaining()) {
        cursor.fail(8, fmt::format("the packed part is said to have {} bytes; {} follow", size,
                                   cursor.remaining()));
    }
    const std::size_t node_size = kNodeHeader + 2 * texel_count(face_px);
    if (count == 0 || count > size * kMostPacked / node_size + 1)
        cursor.fail(12, fmt::format("{} nodes cannot be packed in {} bytes", count, size));
    std::string body(count * node_size, '\0');
    auto unpacked = static_cast<uLongf>(body.size());
    const std::string_view rest = bytes.substr(bytes.size() - cursor.remaining());
    const int status =
        uncompress(reinterpret_cast<Bytef*>(body.data()), &unpacked,
                   reinterpret_cast<const Bytef*>(rest.data()), static_cast<uLong>(rest.size()));
    if (status != Z_OK || unpacked != body.size()) {
        cursor.fail(0, fmt::format("the packed part is damaged, or does not hold {} nodes of {} "
                                   "bytes",
                                   count, node_size));
    }
    VisibilityMaps out;
    out.face_px = static_cast<int>(face_px);
    MapReader reader(body, out.face_px, name);
    for (std::size_t n = 0; n < count; ++n) out.nodes.push_back(reader.read(n));
    return out;
}

}  // namespace zskel
