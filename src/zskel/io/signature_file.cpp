#include "zskel/io/signature_file.h"

#include <fmt/format.h>

#include <cmath>

#include "zskel/core/error.h"
#include "zskel/io/little_endian.h"
#include "zskel/mesh/byte_cursor.h"

namespace zskel {
namespace {

constexpr std::string_view kMagic = "zskelidx";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kStationSize = 4 * (2 + 2 * kProfile);

void expect(ByteCursor& cursor, std::string_view what, std::uint32_t expected) {
    const auto found = cursor.read<std::uint32_t>(what);
    if (found != expected)
        cursor.fail(4, fmt::format("{} {}; this program reads {}", what, found, expected));
}

float read_length(ByteCursor& cursor) {
    const auto value = cursor.read<float>("a length");
    if (!std::isfinite(value) || value < 0.0f)
        cursor.fail(4, fmt::format("{} is not a length: finite and not below 0", value));
    return value;
}

Station read_station(ByteCursor& cursor) {
    Station station;
    station.node = cursor.read<std::uint32_t>("a node");
    for (float& value : station.by_volume) value = read_length(cursor);
    for (float& value : station.by_length) value = read_length(cursor);
    station.radius = read_length(cursor);
    return station;
}

}  // namespace

std::string write_signatures(const std::vector<NamedSignature>& shapes) {
    std::string out(kMagic);
    const auto number = [&](std::size_t value) {
        append_little_endian(out, static_cast<std::uint32_t>(value));
    };
    number(kVersion);
    number(kStations);
    number(kProfile);
    number(shapes.size());
    for (const NamedSignature& shape : shapes) {
        number(shape.name.size());
        out += shape.name;
        for (const Station& station : shape.signature) {
            number(station.node);
            for (const float value : station.by_volume) append_little_endian(out, value);
            for (const float value : station.by_length) append_little_endian(out, value);
            append_little_endian(out, station.radius);
        }
    }
    return out;
}

std::vector<NamedSignature> read_signatures(std::string_view bytes, const std::string& name) {
    if (bytes.substr(0, kMagic.size()) != kMagic) {
        throw InputError(
            fmt::format("{}: no index of shapes: does not begin with {}", name, kMagic));
    }
    ByteCursor cursor(bytes, kMagic.size(), std::endian::little, name);
    expect(cursor, "version", kVersion);
    expect(cursor, "stations of a shape", kStations);
    expect(cursor, "values of a profile", kProfile);
    const auto count = cursor.read<std::uint32_t>("the number of shapes");
    constexpr std::size_t kShapeSize = 4 + kStations * kStationSize;
    if (count > cursor.remaining() / kShapeSize) {
        cursor.fail(4, fmt::format("{} shapes cannot be held in the {} bytes that follow", count,
                                   cursor.remaining()));
    }
    std::vector<NamedSignature> out(count);
    for (NamedSignature& shape : out) {
        const auto size = cursor.read<std::uint32_t>("the size of a name");
        if (size > cursor.remaining())
            cursor.fail(4, fmt::format("a name of {} bytes; {} follow", size, cursor.remaining()));
        shape.name = bytes.substr(bytes.size() - cursor.remaining(), size);
        cursor.skip(size);
        for (std::size_t s = 0; s < kStations; ++s) shape.signature.push_back(read_station(cursor));
    }
    if (cursor.remaining() > 0)
        cursor.fail(0, fmt::format("{} bytes after the last shape", cursor.remaining()));
    return out;
}

}  // namespace zskel
