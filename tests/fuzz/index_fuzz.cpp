// Any bytes as an index of shapes; what was read is written and compared.
#include "fuzz.h"
#include "zskel/io/signature_file.h"

using namespace zskel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::answer([&] {
        const std::string_view bytes = fuzz::text_of(data, size);
        const std::vector<NamedSignature> shapes = read_signatures(bytes, "index");
        const std::vector<NamedSignature> again =
            read_signatures(write_signatures(shapes), "written index");
        fuzz::require(again.size() == shapes.size(), "what was written is what is read");
        if (shapes.size() < 2) return;
        const Match match = match_signatures(shapes[0].signature, shapes[1].signature);
        fuzz::require(match.distance >= 0.0, "a distance is a number from 0 up");
    });
    return 0;
}
