// STL after "StereoLithography Interface Specification", 3D Systems, 1988. Facet normals and
// attribute bytes are not used. A header that begins with "solid" says nothing: the length decides.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "zskel/core/error.h"
#include "zskel/mesh/byte_cursor.h"
#include "zskel/mesh/formats.h"
#include "zskel/mesh/mesh_builder.h"
#include "zskel/mesh/text_cursor.h"
#include "zskel/mesh/weld.h"

namespace zskel {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kAttributeBytes = 2;
/// Bytes of the shortest ascii facet, for a first guess at the number of vertices.
constexpr std::size_t kShortestAsciiFacet = 90;
/// A zero among so many first bytes means that the file is no text.
constexpr std::size_t kLookedAtBytes = 512;

std::uint64_t size_for(std::uint32_t facets) {
    return kHeaderBytes + sizeof facets + std::uint64_t{facets} * kFacetBytes;
}

bool equals_in_any_case(std::string_view word, std::string_view lower) {
    return word == lower ||
           std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                      [](unsigned char a, char b) { return std::tolower(a) == b; });
}

class AsciiStlReader {
  public:
    AsciiStlReader(std::string_view bytes, std::string_view name, const ReadOptions& options)
        : text_(bytes, name),
          builder_(name, options.max_faces),
          places_(bytes.size() / kShortestAsciiFacet / 2) {}

    Mesh read() {
        do {
            expect("solid");
            text_.next_line();
            read_facets();
            text_.next_line();
        } while (text_.to_content());
        builder_.positions = places_.take_places();
        return builder_.finish();
    }

  private:
    /// All facets of one solid, and its endsolid.
    void read_facets() {
        while (true) {
            const std::string_view word = next_word();
            if (equals_in_any_case(word, "endsolid")) return;
            if (!equals_in_any_case(word, "facet")) fail_keyword(word, "facet or endsolid");
            read_facet();
        }
    }

    void read_facet() {
        expect("normal");
        for (int axis = 0; axis < 3; ++axis) {
            text_.to_content();
            text_.number("facet normal");
        }
        expect("outer");
        expect("loop");
        std::array<std::uint32_t, 3> corners{};
        for (std::uint32_t& corner : corners) corner = places_.add(read_vertex());
        expect("endloop");
        expect("endfacet");
        builder_.add_face(corners);
    }

    DVec3 read_vertex() {
        expect("vertex");
        DVec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            text_.to_content();
            position[axis] = text_.finite_number("vertex coordinate");
        }
        return position;
    }

    void expect(std::string_view keyword) {
        const std::string_view word = next_word();
        if (!equals_in_any_case(word, keyword)) fail_keyword(word, keyword);
    }

    std::string_view next_word() { return text_.to_content() ? text_.word() : std::string_view{}; }

    [[noreturn]] void fail_keyword(std::string_view seen, std::string_view expected) const {
        const std::string found = seen.empty() ? "the end of the file" : quoted(seen);
        text_.fail(fmt::format("expected {}, found {}", expected, found));
    }

    TextCursor text_;
    MeshBuilder builder_;
    PlaceIndex places_;
};

DVec3 read_binary_vertex(ByteCursor& data) {
    DVec3 position;
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = data.read<float>("a vertex");
        if (!std::isfinite(value)) {
            data.fail(sizeof value,
                      fmt::format("vertex coordinate {} is not a finite number", value));
        }
        position[axis] = value;
    }
    return position;
}

Mesh read_binary(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    ByteCursor data(bytes, kHeaderBytes, std::endian::little, name);
    const auto facets = data.read<std::uint32_t>("the number of facets");
    if (size_for(facets) != bytes.size()) {
        data.fail(sizeof facets, fmt::format("{} facets declared, which make a file of {} bytes; "
                                             "this one has {}",
                                             facets, size_for(facets), bytes.size()));
    }
    MeshBuilder builder(name, options.max_faces);
    builder.reserve_faces(facets);
    PlaceIndex places(facets / 2 + 2);  // a closed surface has half as many vertices as triangles
    for (std::uint32_t facet = 0; facet < facets; ++facet) {
        data.skip(kNormalBytes);
        std::array<std::uint32_t, 3> corners{};
        for (std::uint32_t& corner : corners) corner = places.add(read_binary_vertex(data));
        data.skip(kAttributeBytes);
        builder.add_face(corners);
    }
    builder.positions = places.take_places();
    return builder.finish();
}

/// True when the first word is "solid" and what follows looks like text.
bool begins_as_ascii(std::string_view bytes) {
    if (bytes.substr(0, kLookedAtBytes).find('\0') != std::string_view::npos) return false;
    TextCursor text(bytes, {});
    return text.to_content() && equals_in_any_case(text.word(), "solid");
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
    if (bytes.size() < kHeaderBytes + sizeof(std::uint32_t)) return false;
    ByteCursor data(bytes, kHeaderBytes, std::endian::little, {});
    return size_for(data.read<std::uint32_t>("the number of facets")) == bytes.size();
}

Mesh read_stl(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    if (!is_binary_stl(bytes) && begins_as_ascii(bytes))
        return AsciiStlReader(bytes, name, options).read();
    if (bytes.size() >= kHeaderBytes) return read_binary(bytes, name, options);
    throw InputError(
        fmt::format("{}: {} bytes that begin with {}; expected 'solid' (ascii STL) or {} "
                    "bytes and more (binary)",
                    name, bytes.size(), quoted(bytes.substr(0, 8)), size_for(1)));
}

}  // namespace zskel
