// Any bytes as a file of visibility maps; what was read is written and read again.
#include "fuzz.h"
#include "zskel/io/map_file.h"

using namespace zskel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::answer([&] {
        const VisibilityMaps maps = read_visibility_maps(fuzz::text_of(data, size), "maps");
        const VisibilityMaps again =
            read_visibility_maps(write_visibility_maps(maps), "written maps");
        fuzz::require(again.face_px == maps.face_px && again.nodes.size() == maps.nodes.size(),
                      "what was written is what is read");
    });
    return 0;
}
