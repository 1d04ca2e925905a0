#include "zskel/gl/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "glsl_sources.h"
#include "zskel/core/error.h"
#include "zskel/core/log.h"
#include "zskel/gl/api.h"
#include "zskel/gl/depth_target.h"
#include "zskel/gl/native_context.h"
#include "zskel/gl/program.h"

namespace zskel::gl {
namespace {

constexpr int kMostErrors = 100;  // that are taken off a context: a broken one may never stop

std::string_view error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        default:
            return "an unknown GL error";
    }
}

std::string_view blame_of(GLenum reset) {
    switch (reset) {
        case GL_GUILTY_CONTEXT_RESET:
            return ": the GPU was reset for what it did";
        case GL_INNOCENT_CONTEXT_RESET:
            return ": the GPU was reset for what another context did";
        case GL_UNKNOWN_CONTEXT_RESET:
            return ": the GPU was reset";
        default:
            return "";
    }
}

Api load_api(NativeContext& native) {
    Api api;
    const auto load = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(native.find(name));
        if (function == nullptr) throw GlError(fmt::format("the driver has no {}", name));
    };
#define ZSKEL_GL_LOAD(type, name) load(api.name, "gl" #name);
    ZSKEL_GL_FUNCTIONS(ZSKEL_GL_LOAD)
#undef ZSKEL_GL_LOAD
    return api;
}

std::string text_of(const Api& gl, GLenum what) {
    const GLubyte* text = gl.GetString(what);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

bool has_extension(const Api& gl, std::string_view wanted) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (name != nullptr && wanted == reinterpret_cast<const char*>(name)) return true;
    }
    return false;
}

// A known triangle: it covers layer 1 of two at depth_axial 4, and a nearer one the lower half of
// it.
void probe(const Api& gl) {
    constexpr int kPx = 4;
    const GLuint program =
        build_program(gl, {{GL_VERTEX_SHADER, "probe.vert", glsl::kProbeVert},
                           {GL_FRAGMENT_SHADER, "depth.frag", glsl::kDepthFrag}});
    GLuint empty = 0;
    gl.CreateVertexArrays(1, &empty);
    DepthTarget target(gl, kPx, 2);
    set_reversed_depth(gl);
    target.begin(gl);
    gl.UseProgram(program);
    gl.BindVertexArray(empty);
    gl.DrawArrays(GL_TRIANGLES, 0, 6);
    std::vector<float> depth(2 * kPx * kPx);
    std::vector<std::uint32_t> id(depth.size());
    target.read(gl, 2, depth, id);
    target.destroy(gl);
    gl.DeleteVertexArrays(1, &empty);
    gl.DeleteProgram(program);
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const std::size_t row = i / kPx % kPx;
        const bool drawn = i >= kPx * kPx;
        const bool lower = row < kPx / 2;
        const float expected = !drawn ? 0.0f : lower ? 0.5f : 0.25f;
        const std::uint32_t expected_id = !drawn ? 0xFFFFFFFFu : lower ? 1u : 0u;
        if (std::abs(depth[i] - expected) > 1e-6f || id[i] != expected_id) {
            throw GlError(
                fmt::format("the probe's texel {} reads depth {} and id {}; it should be {} and "
                            "{}: this driver cannot be trusted",
                            i, depth[i], id[i], expected, expected_id));
        }
    }
}

ContextInfo inspect(const Api& gl, const Candidate& candidate) {
    ContextInfo info;
    info.kind = candidate.kind;
    info.device = candidate.device;
    info.vendor = text_of(gl, GL_VENDOR);
    info.renderer = text_of(gl, GL_RENDERER);
    info.version = text_of(gl, GL_VERSION);
    gl.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &info.max_layers);
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &info.max_texture_px);
    gl.GetIntegerv(GL_MAX_SAMPLES, &info.max_samples);
    return info;
}

// Lets one thread own the context; `run` hands it work and waits.
class ThreadContext : public Context {
  public:
    explicit ThreadContext(const Candidate& candidate) {
        thread_ = std::thread([this, candidate] { serve(candidate); });
        std::unique_lock lock(mutex_);
        done_.wait(lock, [&] { return ready_; });
        if (failure_) {
            lock.unlock();
            thread_.join();
            std::rethrow_exception(failure_);
        }
    }

    ~ThreadContext() override {
        {
            const std::scoped_lock lock(mutex_);
            quit_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

    void run(std::string_view stage, const std::function<void(const Api&)>& work) override {
        const std::scoped_lock one_caller(callers_);
        std::unique_lock lock(mutex_);
        stage_ = stage;
        work_ = &work;
        ready_ = false;
        wake_.notify_one();
        done_.wait(lock, [&] { return ready_; });
        if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    }

    const ContextInfo& info() const override { return info_; }

  private:
    void serve(const Candidate& candidate) {
        std::unique_ptr<NativeContext> native;
        Api api;
        attempt([&] {
            const auto start = std::chrono::steady_clock::now();
            native = candidate.kind == ContextKind::Osmesa ? make_osmesa_context()
                                                           : make_egl_context(candidate);
            open(*native, api, candidate);
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            info_.seconds = passed.count();
        });
        std::unique_lock lock(mutex_);
        const bool opened = !failure_;
        ready_ = true;
        done_.notify_one();
        while (opened) {
            wake_.wait(lock, [&] { return quit_ || work_ != nullptr; });
            if (quit_) break;
            const auto* work = std::exchange(work_, nullptr);
            lock.unlock();
            attempt([&] {
                if (is_lost_) throw GlError(fmt::format("{}: the context was lost before", stage_));
                try {
                    (*work)(api);
                } catch (const GlError&) {
                    check(api);  // may know better, and leaves nothing behind
                    throw;
                } catch (...) {
                    forget_errors(api);
                    throw;
                }
                check(api);
            });
            lock.lock();
            ready_ = true;
            done_.notify_one();
        }
    }

    void open(NativeContext& native, Api& api, const Candidate& candidate) {
        api = load_api(native);
        info_ = inspect(api, candidate);
        stage_ = "probe";
        GLint major = 0;
        GLint minor = 0;
        api.GetIntegerv(GL_MAJOR_VERSION, &major);
        api.GetIntegerv(GL_MINOR_VERSION, &minor);
        if (major * 10 + minor < 45) {
            throw GlError(fmt::format("it gives OpenGL {}.{}; 4.5 is needed ({})", major, minor,
                                      info_.renderer));
        }
        if (!has_extension(api, "GL_ARB_shader_viewport_layer_array")) {
            throw GlError(
                fmt::format("{} lacks GL_ARB_shader_viewport_layer_array", info_.renderer));
        }
        api.Enable(GL_DEBUG_OUTPUT);
        api.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        api.DebugMessageCallback(&ThreadContext::record, this);
        probe(api);
        check(api);
    }

    static void APIENTRY record(GLenum, GLenum type, GLuint, GLenum, GLsizei length,
                                const GLchar* text, const void* user) {
        if (type != GL_DEBUG_TYPE_ERROR) return;
        auto* self = const_cast<ThreadContext*>(static_cast<const ThreadContext*>(user));
        const std::size_t size = length < 0 ? std::strlen(text) : static_cast<std::size_t>(length);
        if (self->said_.size() < 4096)
            self->said_ += fmt::format(" [{}]", std::string_view(text, size));
    }

    static void forget_errors(const Api& api) {
        for (int i = 0; i < kMostErrors && api.GetError() != GL_NO_ERROR; ++i) {
        }
    }

    void check(const Api& api) {
        const GLenum reset = api.GetGraphicsResetStatus();
        const GLenum error = api.GetError();
        is_lost_ = reset != GL_NO_ERROR || error == GL_CONTEXT_LOST;
        if (is_lost_) {
            throw GlError(fmt::format("{} failed: the context on {} was lost{}{}", stage_,
                                      info_.renderer, blame_of(reset), said_));
        }
        if (error == GL_NO_ERROR) return;
        forget_errors(api);
        throw GlError(fmt::format("{} failed with {} on {}{}", stage_, error_name(error),
                                  info_.renderer, said_));
    }

    template <typename Work>
    void attempt(Work work) {
        said_.clear();
        try {
            work();
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    std::mutex callers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable done_;
    const std::function<void(const Api&)>* work_ = nullptr;
    bool ready_ = false;
    bool quit_ = false;
    bool is_lost_ = false;  // for good: the GPU was reset, or taken away
    std::exception_ptr failure_;
    std::string stage_ = "opening the context";
    std::string said_;  // by the driver's debug output, during the present work
    ContextInfo info_;
    std::thread thread_;
};

bool wanted(const ContextRequest& request, const Candidate& candidate) {
    switch (candidate.kind) {
        case ContextKind::EglHardware:
            return request.hardware && (request.gpu < 0 || request.gpu == candidate.device);
        case ContextKind::EglSoftware:
        case ContextKind::EglSurfaceless:
            return request.software && request.gpu < 0;
        case ContextKind::Osmesa:
            return request.osmesa && request.gpu < 0;
    }
    return false;
}

std::vector<Candidate> list_candidates(const ContextRequest& request,
                                       std::vector<FailedAttempt>& failed) {
    std::vector<Candidate> all;
    if (request.hardware || request.software) {
        all = list_egl_candidates(failed);
        std::stable_sort(all.begin(), all.end(),
                         [](const Candidate& l, const Candidate& r) { return l.kind < r.kind; });
    }
    all.push_back({ContextKind::Osmesa, -1, "OSMesa"});
    std::erase_if(all, [&](const Candidate& candidate) { return !wanted(request, candidate); });
    if (request.gpu >= 0 && all.empty()) {
        failed.push_back(
            {fmt::format("EGL hardware device {}", request.gpu), "EGL lists no such device"});
    }
    return all;
}

}  // namespace

std::string_view name_of(ContextKind kind) {
    switch (kind) {
        case ContextKind::EglHardware:
            return "egl-hardware";
        case ContextKind::EglSoftware:
            return "egl-software";
        case ContextKind::EglSurfaceless:
            return "egl-surfaceless";
        case ContextKind::Osmesa:
            return "osmesa";
    }
    return "";
}

void Context::release(std::string_view stage,
                      const std::function<void(const Api&)>& work) noexcept {
    try {
        run(stage, work);
    } catch (const std::exception& error) {
        log_warning("{}", error.what());
    }
}

std::unique_ptr<Context> open_context(const ContextRequest& request,
                                      std::vector<FailedAttempt>& failed) {
    const std::size_t known = failed.size();
    const std::vector<Candidate> candidates = list_candidates(request, failed);
    for (std::size_t i = known; i < failed.size(); ++i)
        log_info("{} cannot be used: {}", failed[i].candidate, failed[i].reason);
    for (const Candidate& candidate : candidates) {
        try {
            auto context = std::make_unique<ThreadContext>(candidate);
            log_info("GL context: {}, {} ({:.0f} ms)", candidate.name, context->info().renderer,
                     context->info().seconds * 1e3);
            return context;
        } catch (const Error& error) {
            log_info("{} cannot be used: {}", candidate.name, error.what());
            failed.push_back({candidate.name, error.what()});
        }
    }
    return nullptr;
}

std::vector<Diagnosis> diagnose_contexts(const ContextRequest& request) {
    std::vector<FailedAttempt> failed;
    std::vector<Diagnosis> found;
    const std::vector<Candidate> candidates = list_candidates(request, failed);
    found.reserve(failed.size() + candidates.size());
    for (const FailedAttempt& attempt : failed)
        found.push_back({attempt.candidate, false, {}, attempt.reason});
    for (const Candidate& candidate : candidates) {
        try {
            found.push_back({candidate.name, true, ThreadContext(candidate).info(), ""});
        } catch (const Error& error) {
            found.push_back({candidate.name, false, {}, error.what()});
        }
    }
    return found;
}

}  // namespace zskel::gl
