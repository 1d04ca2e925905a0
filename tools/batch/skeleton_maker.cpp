#include "batch/skeleton_maker.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <new>
#include <utility>

#include "batch/item_key.h"
#include "batch/peak_memory.h"
#include "batch/shared_gpu.h"
#include "scoring/base64.h"
#include "zskel/core/input_file.h"
#include "zskel/core/parallel.h"
#include "zskel/io/output_file.h"
#include "zskel/io/picture.h"
#include "zskel/io/skeleton_json.h"

namespace zskel::batch {
namespace {

constexpr std::size_t kMostWarnings = 100;  // of one item, in the journal
constexpr int kMostConnections = 3;         // to one GPU process after the other
constexpr int kThumbnailWidthPx = 160;
constexpr int kThumbnailHeightPx = 120;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string_view reason_of(ExitCode code) {
    switch (code) {
        case ExitCode::Usage:
        case ExitCode::Input:
            return "bad_input";
        case ExitCode::Backend:
            return "no_backend";
        case ExitCode::Io:
            return "cannot_write";
        case ExitCode::Check:
            return "self_check";
        case ExitCode::Limit:
            return "limit";
        default:
            return "internal";
    }
}

void set_failure(Record& record, ExitCode code, std::string_view reason, std::string text) {
    record.status = Status::Failed;
    record.exit_code = static_cast<int>(code);
    record.reason = reason;
    record.text = std::move(text);
}

bool still_holds(const Request& request, const Record& record) {
    if (!request.known || request.known->key != record.key) return false;
    std::error_code unknown;
    return request.known->has_failed || std::filesystem::is_regular_file(request.output, unknown);
}

void keep_warnings(const std::vector<std::string>& warnings, Record& record) {
    record.warnings.assign(
        warnings.begin(),
        warnings.begin() + static_cast<std::ptrdiff_t>(std::min(warnings.size(), kMostWarnings)));
    if (warnings.size() > kMostWarnings)
        record.warnings.push_back(fmt::format("and {} more", warnings.size() - kMostWarnings));
    record.status = warnings.empty() ? Status::Ok : Status::Warned;
}

}  // namespace

SkeletonMaker::SkeletonMaker(Task task, std::string gpu_address)
    : task_(std::move(task)), gpu_address_(std::move(gpu_address)) {}
SkeletonMaker::~SkeletonMaker() = default;

Record SkeletonMaker::make(const Request& request,
                           const std::function<void(const Record&)>& begun) {
    Record record;
    record.model = request.model;
    record.output = request.output;
    forget_peak_memory();
    const auto start = std::chrono::steady_clock::now();
    try {
        work(request, begun, record);
    } catch (const Error& error) {
        fail(error, record);
        // What failed before there was a key, as a file that is not there does.
        if (record.key.empty() && still_holds(request, record)) record.status = Status::Skipped;
    } catch (const std::bad_alloc&) {
        set_failure(record, ExitCode::Limit, "memory",
                    "more memory is needed than --item-memory allows, or than there is");
    } catch (const std::exception& error) {
        set_failure(record, ExitCode::Internal, "internal", error.what());
    }
    record.seconds = seconds_since(start);
    record.peak_memory_kib = peak_memory_kib();
    return record;
}

void SkeletonMaker::fail(const Error& error, Record& record) {
    const bool is_memory = dynamic_cast<const MemoryError*>(&error) != nullptr;
    set_failure(record, error.code(), is_memory ? "memory" : reason_of(error.code()), error.what());
    // A context may be lost; the next item gets a new one.
    if (error.code() == ExitCode::Backend) backends_ = {};
}

void SkeletonMaker::work(const Request& request, const std::function<void(const Record&)>& begun,
                         Record& record) {
    if (std::exchange(is_alone_, request.is_alone) != request.is_alone) backends_ = {};
    const SkeletonFormat format =
        task_.format ? *task_.format : skeleton_format_of_path(request.output);
    record.backend = resolved_backend(request.model);
    record.key =
        item_key(read_input_file(request.model, "a model").text(), task_, format, record.backend);
    begun(record);
    if (still_holds(request, record)) {
        record.status = Status::Skipped;
        return;
    }
    const Mesh mesh = read_mesh(request.model, task_.reading);
    const BackendOptions options = backend_options_for(mesh, task_.extract, task_.backend);
    Backend& backend = backend_for(options);
    const ExtractResult result = extract_skeleton(mesh, task_.extract, backend);
    const Provenance provenance{request.model, mesh.hash, task_.command,
                                task_.extract, options,   backend.info()};
    write_output_text(request.output,
                      format == SkeletonFormat::Json
                          ? skeleton_json(result, provenance, {})
                          : write_skeleton(result.graph, format, {task_.tubes, task_.command}));
    keep_warnings(result.warnings, record);
    if (request.wants_thumbnail) add_thumbnail(result, record);
    if (task_.strict && !result.check.failures.empty()) {
        set_failure(record, ExitCode::Check, "self_check",
                    fmt::format("{}", fmt::join(result.check.failures, "; ")));
    }
}

Backend& SkeletonMaker::backend_for(const BackendOptions& options) {
    Choice choice{uses_gl(options), ""};
    if (options.kind == BackendKind::Auto && !choice.is_gpu) {
        choice = choose_source(options.work, options.face_px, thread_count(), has_gpu_device());
    }
    std::unique_ptr<Backend>& backend = backends_[choice.is_gpu ? 1 : 0];
    if (backend && has_lost_process(*backend)) backend.reset();
    if (!backend) backend = open(options, choice);
    return *backend;
}

// From the process that all share, or the one in its place. Where it can have no GPU, Auto says so
// and takes what there is.
std::unique_ptr<Backend> SkeletonMaker::open(const BackendOptions& options,
                                             const Choice& choice) const {
    if (choice.is_gpu && !is_alone_ && !gpu_address_.empty()) {
        for (int attempt = 1;; ++attempt) {
            try {
                return open_shared_gpu(gpu_address_, options.face_px, choice.reason);
            } catch (const GpuProcessLost&) {
                if (attempt == kMostConnections) throw;
            } catch (const GlError&) {
                if (uses_gl(options)) throw;
                return open_backend(options);
            }
        }
    }
    return open_backend(options);
}

// Where Auto weighs how much there is to do, the model has to be read to know.
std::string SkeletonMaker::resolved_backend(const std::string& model) {
    BackendOptions options = task_.backend;
    if (options.kind == BackendKind::Auto && options.gpu < 0 && has_gpu_device()) {
        options = backend_options_for(read_mesh(model, task_.reading), task_.extract, options);
    } else {
        options = backend_options_for({}, task_.extract, options);
    }
    return backend_for(options).info().name;
}

void SkeletonMaker::add_thumbnail(const ExtractResult& result, Record& record) {
    try {
        if (!no_picture_.empty()) throw GlError(no_picture_);
        if (!picture_context_) picture_context_ = open_picture_context();
        const PictureOptions size{kThumbnailWidthPx, kThumbnailHeightPx, std::nullopt};
        const Image image = draw_skeleton(*picture_context_, result.surface, result.graph, size);
        record.thumbnail = scoring::base64(encode_png(image, record.model));
    } catch (const Error& error) {
        if (!picture_context_) no_picture_ = error.what();
        picture_context_ = {};  // it may be lost
        record.no_thumbnail = error.what();
    }
}

}  // namespace zskel::batch
