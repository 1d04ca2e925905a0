#include "zskel/visibility/backend.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <array>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/visibility/cpu_source.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/raster_source.h"
#include "zskel/visibility/ray_source.h"

namespace zskel {
namespace {

constexpr std::array<std::pair<BackendKind, std::string_view>, 7> kNames{{
    {BackendKind::Auto, "auto"},
    {BackendKind::Gl, "gl"},
    {BackendKind::Egl, "egl"},
    {BackendKind::Osmesa, "osmesa"},
    {BackendKind::Cpu, "cpu"},
    {BackendKind::Ray, "ray"},
    {BackendKind::Brute, "brute"},
}};

class GlBackend : public Backend {
  public:
    GlBackend(BackendInfo info, std::unique_ptr<gl::Context> context, int face_px)
        : Backend(std::move(info)),
          context_(std::move(context)),
          pipeline_(make_raster_pipeline(face_px, *context_)) {}
    std::unique_ptr<VisibilitySource> prepare(const Surface& solid) override {
        return make_raster_source(solid, *pipeline_);
    }
    void look(std::span<const Look> looks) override { look_at_once(looks, *pipeline_); }

  private:
    std::unique_ptr<gl::Context> context_;
    RasterPipelinePtr pipeline_;
};

class RayBackend : public Backend {
  public:
    RayBackend(BackendInfo info, Directions directions, RayMethod method)
        : Backend(std::move(info)), directions_(std::move(directions)), method_(method) {}
    std::unique_ptr<VisibilitySource> prepare(const Surface& solid) override {
        return make_ray_source(solid, directions_, method_);
    }

  private:
    Directions directions_;
    RayMethod method_;
};

class CpuBackend : public Backend {
  public:
    CpuBackend(BackendInfo info, int face_px, CpuDetail detail)
        : Backend(std::move(info)), face_px_(face_px), detail_(detail) {}
    std::unique_ptr<VisibilitySource> prepare(const Surface& solid) override {
        return make_cpu_source(solid, face_px_, detail_);
    }

  private:
    int face_px_;
    CpuDetail detail_;
};

bool is_ray(BackendKind kind) {
    return kind == BackendKind::Ray || kind == BackendKind::Brute;
}

gl::ContextRequest request_for(const BackendOptions& options) {
    gl::ContextRequest request;
    request.gpu = options.gpu;
    request.hardware = options.kind != BackendKind::Osmesa;
    request.software = options.kind != BackendKind::Osmesa;
    request.osmesa = options.kind != BackendKind::Egl;
    return request;
}

std::unique_ptr<Backend> open_rays(const BackendOptions& options, BackendInfo info) {
    const bool brute = options.kind == BackendKind::Brute;
    info.name = brute ? "brute" : "ray";
    info.vendor = brute ? "zskel" : "Embree";
    info.renderer = brute ? "every ray against every triangle" : "packets of 16 rays";
    info.version = brute ? ZSKEL_VERSION : RTC_VERSION_STRING;
    Directions directions =
        options.rays > 0 ? radial_directions(options.rays) : cube_directions(options.face_px);
    return std::make_unique<RayBackend>(std::move(info), std::move(directions),
                                        brute ? RayMethod::BruteForce : RayMethod::Embree);
}

std::unique_ptr<Backend> open_cpu(const BackendOptions& options, BackendInfo info) {
    info.name = "cpu";
    info.vendor = "zskel";
    info.renderer = fmt::format("Z-buffer, {}", cpu_instruction_set());
    info.version = ZSKEL_VERSION;
    info.is_raster = true;
    info.has_levels = !options.exact;
    const CpuDetail detail = options.exact ? CpuDetail::Exact : CpuDetail::Levels;
    return std::make_unique<CpuBackend>(std::move(info), options.face_px, detail);
}

std::string reasons(const std::vector<gl::FailedAttempt>& failed) {
    std::string text;
    for (const gl::FailedAttempt& attempt : failed) {
        text +=
            fmt::format("{}{}: {}", text.empty() ? "" : "; ", attempt.candidate, attempt.reason);
    }
    return text.empty() ? "no candidate" : text;
}

std::unique_ptr<Backend> open_gl(const BackendOptions& options, BackendInfo info,
                                 std::unique_ptr<gl::Context> context) {
    info.name = gl::name_of(context->info().kind);
    info.vendor = context->info().vendor;
    info.renderer = context->info().renderer;
    info.version = context->info().version;
    info.is_raster = true;
    return std::make_unique<GlBackend>(std::move(info), std::move(context), options.face_px);
}

std::unique_ptr<gl::Context> open_hardware(int gpu, std::vector<gl::FailedAttempt>& failed) {
    gl::ContextRequest request;
    request.gpu = gpu;
    request.software = false;
    request.osmesa = false;
    return gl::open_context(request, failed);
}

// Auto: the CPU, or a GPU where it pays and works.
std::unique_ptr<Backend> open_fastest(const BackendOptions& options, BackendInfo info) {
    const Choice choice =
        choose_source(options.work, options.face_px, thread_count(), has_gpu_device());
    info.reason = choice.reason;
    if (choice.is_gpu) {
        std::unique_ptr<gl::Context> context = open_hardware(options.gpu, info.failed);
        if (context != nullptr) {
            try {
                auto backend = open_gl(options, info, std::move(context));
                log_info("backend auto: a GPU: {}", info.reason);
                return backend;
            } catch (const GlError& error) {
                info.failed.push_back({"the GPU's pipeline", error.what()});
            }
        }
        info.reason += "; but no GPU can be used";
        log_warning("backend auto: {}: {}", info.reason, reasons(info.failed));
    }
    log_info("backend auto: the CPU: {}", info.reason);
    return open_cpu(options, std::move(info));
}

}  // namespace

void Backend::look(std::span<const Look> looks) {
    for (const Look& look : looks) look.source->look(look.eyes, look.records);
}

BackendKind parse_backend(std::string_view name) {
    for (const auto& [kind, known] : kNames) {
        if (known == name) return kind;
    }
    throw UsageError(
        fmt::format("unknown backend '{}': auto, gl, egl, osmesa, cpu, ray or brute", name));
}

std::string_view name_of(BackendKind kind) {
    for (const auto& [known, name] : kNames) {
        if (known == kind) return name;
    }
    return "";
}

void check_backend_options(const BackendOptions& options) {
    if (options.rays != 0 && !is_ray(options.kind)) {
        throw UsageError(fmt::format(
            "--rays goes with --backend ray or brute; {} samples a cube map (--face-px)",
            name_of(options.kind)));
    }
    const bool no_gpu = is_ray(options.kind) || options.kind == BackendKind::Cpu ||
                        options.kind == BackendKind::Osmesa;
    if (options.gpu >= 0 && no_gpu) {
        throw UsageError(fmt::format("--gpu goes with a GL backend on hardware, not with {}",
                                     name_of(options.kind)));
    }
    if (options.face_px != 0) check_face_px(options.face_px);
}

bool uses_gl(const BackendOptions& options) {
    return options.kind == BackendKind::Gl || options.kind == BackendKind::Egl ||
           options.kind == BackendKind::Osmesa ||
           (options.kind == BackendKind::Auto && options.gpu >= 0);
}

namespace {

BackendOptions completed(BackendOptions options) {
    if (options.face_px == 0) options.face_px = kDefaultFacePx;
    check_backend_options(options);
    return options;
}

}  // namespace

std::unique_ptr<Backend> open_backend(const BackendOptions& given) {
    const BackendOptions options = completed(given);
    BackendInfo info;
    if (is_ray(options.kind)) return open_rays(options, std::move(info));
    if (options.kind == BackendKind::Cpu) return open_cpu(options, std::move(info));
    if (options.kind == BackendKind::Auto && options.gpu < 0)
        return open_fastest(options, std::move(info));
    std::unique_ptr<gl::Context> context = gl::open_context(request_for(options), info.failed);
    if (context == nullptr) {
        throw GlError(fmt::format("backend {} cannot be used: {} (see zskel doctor)",
                                  name_of(options.kind), reasons(info.failed)));
    }
    return open_gl(options, std::move(info), std::move(context));
}

std::unique_ptr<Backend> open_gpu(const BackendOptions& given) {
    const BackendOptions options = completed(given);
    BackendInfo info;
    std::unique_ptr<gl::Context> context = open_hardware(options.gpu, info.failed);
    if (context == nullptr) {
        throw GlError(
            fmt::format("no GPU can be used: {} (see zskel doctor)", reasons(info.failed)));
    }
    return open_gl(options, std::move(info), std::move(context));
}

std::unique_ptr<gl::Context> open_picture_context(int gpu) {
    gl::ContextRequest request;
    request.gpu = gpu;
    std::vector<gl::FailedAttempt> failed;
    std::unique_ptr<gl::Context> context = gl::open_context(request, failed);
    if (context == nullptr) {
        throw GlError(
            fmt::format("a picture needs a GL context: {} (see zskel doctor)", reasons(failed)));
    }
    return context;
}

}  // namespace zskel
