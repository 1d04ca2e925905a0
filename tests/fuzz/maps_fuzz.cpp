// Any bytes as a file of visibility maps; what was read is written and read again. Bytes that do
// not begin as such a file does are taken as what its packed part holds, which no mutation of
// packed bytes would get at.
#include "fuzz.h"
#include "zskel/io/little_endian.h"
#include "zskel/io/map_file.h"
#include "zskel/io/packing.h"

using namespace zskel;

namespace {

constexpr std::uint32_t kFacePx = 4;
constexpr std::size_t kNodeBytes = 36 + 2 * 6 * kFacePx * kFacePx;

std::string file_of(std::string_view body) {
    const std::size_t nodes = body.size() / kNodeBytes;
    const std::string rest = packed(body.substr(0, nodes * kNodeBytes));
    std::string out = "zskelmap";
    for (const std::size_t number : {std::size_t{1}, std::size_t{kFacePx}, nodes})
        append_little_endian(out, static_cast<std::uint32_t>(number));
    append_little_endian(out, static_cast<std::uint64_t>(rest.size()));
    return out + rest;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::answer([&] {
        const std::string_view bytes = fuzz::text_of(data, size);
        const VisibilityMaps maps = is_visibility_maps(bytes)
                                        ? read_visibility_maps(bytes, "maps")
                                        : read_visibility_maps(file_of(bytes), "packed maps");
        const VisibilityMaps again =
            read_visibility_maps(write_visibility_maps(maps), "written maps");
        fuzz::require(again.face_px == maps.face_px && again.nodes.size() == maps.nodes.size(),
                      "what was written is what is read");
    });
    return 0;
}
