#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace zskel::gl {

struct Api;

/// The ways to an offscreen context, in the order in which they are tried.
enum class ContextKind { EglHardware, EglSoftware, EglSurfaceless, Osmesa };
std::string_view name_of(ContextKind kind);

/// What a context says of itself.
struct ContextInfo {
    ContextKind kind = ContextKind::EglSurfaceless;
    int device = -1;  ///< number among the devices of its kind; -1 where there are none
    std::string vendor;
    std::string renderer;
    std::string version;
    int max_layers = 0;      ///< GL_MAX_ARRAY_TEXTURE_LAYERS
    int max_texture_px = 0;  ///< GL_MAX_TEXTURE_SIZE
    int max_samples = 0;     ///< GL_MAX_SAMPLES
    double seconds = 0.0;    ///< from the first call to the probe's right answer
};

/// A candidate that gave no context, and why.
struct FailedAttempt {
    std::string candidate;
    std::string reason;
};

/// Which candidates to try.
struct ContextRequest {
    bool hardware = true;
    bool software = true;  ///< the EGL software device and the surfaceless platform
    bool osmesa = true;
    int gpu = -1;  ///< number of the one hardware device to take; -1: the first that works
};

/// An offscreen GL 4.5 core context on a thread of its own, so that no caller's context is ever
/// touched.
class Context {
  public:
    virtual ~Context() = default;

    /// Runs `work` on the context's thread with the context current, and waits for it.
    /// Exceptions of `work` come back here; a GL error that it leaves behind is thrown as GlError,
    /// naming `stage` and what the driver's debug output said. A lost context (the GPU was reset)
    /// stays lost: that and every later call throws GlError. Safe to call from any thread, one call
    /// at a time.
    virtual void run(std::string_view stage, const std::function<void(const Api&)>& work) = 0;

    virtual const ContextInfo& info() const = 0;

    /// `run` for destructors: what goes wrong is logged.
    void release(std::string_view stage, const std::function<void(const Api&)>& work) noexcept;
};

/// The first candidate of the request that draws a known triangle into a layered 32F depth target
/// and reads the right depth back.
/// @param failed  receives every candidate that was tried before, with the reason.
/// @return        null when none is usable.
std::unique_ptr<Context> open_context(const ContextRequest& request,
                                      std::vector<FailedAttempt>& failed);

/// Tries every candidate of the request on its own, for `zskel doctor`.
struct Diagnosis {
    std::string candidate;
    bool usable = false;
    ContextInfo info;
    std::string reason;
};
std::vector<Diagnosis> diagnose_contexts(const ContextRequest& request);

}  // namespace zskel::gl
