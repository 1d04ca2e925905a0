#include "batch/item_key.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "zskel/io/skeleton_json.h"

namespace zskel::batch {
namespace {

// However the backend was asked for, it is the one that answers.
std::string options_of(const Task& task) {
    Provenance made;
    made.options = task.extract;
    made.backend_options = task.backend;
    made.backend_options.kind = BackendKind::Auto;
    made.backend_options.gpu = -1;
    return options_text(made);
}

}  // namespace

std::string item_key(std::string_view model_bytes, const Task& task, SkeletonFormat format,
                     const std::string& backend) {
    const std::string all = fmt::format(
        "{:016x} {} {} {} {} {} {} {}", XXH3_64bits(model_bytes.data(), model_bytes.size()),
        ZSKEL_VERSION, backend, options_of(task), info_of(format).name, task.tubes, task.strict,
        task.reading.chord_error);
    return fmt::format("{:016x}", XXH3_64bits(all.data(), all.size()));
}

}  // namespace zskel::batch
