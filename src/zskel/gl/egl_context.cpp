// EGL contexts without a display server: a device of EGL_EXT_device_enumeration, or Mesa's
// surfaceless platform. libEGL is loaded when it is asked for, so that a program that draws nothing
// pays nothing.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "zskel/core/error.h"
#include "zskel/gl/native_context.h"

namespace zskel::gl {
namespace {

struct Egl {
    PFNEGLGETPROCADDRESSPROC get_proc_address = nullptr;
    PFNEGLQUERYSTRINGPROC query_string = nullptr;
    PFNEGLGETERRORPROC get_error = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLBINDAPIPROC bind_api = nullptr;
    PFNEGLCHOOSECONFIGPROC choose_config = nullptr;
    PFNEGLCREATECONTEXTPROC create_context = nullptr;
    PFNEGLMAKECURRENTPROC make_current = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
    std::string missing;     // why this cannot be used; empty when it can
    std::string no_devices;  // why no device can be listed; empty when they can
};

template <typename Function>
void load(Egl& egl, void* library, Function& function, const char* name, std::string& missing) {
    void* found = dlsym(library, name);
    if (found == nullptr && egl.get_proc_address != nullptr) {
        found = reinterpret_cast<void*>(egl.get_proc_address(name));
    }
    function = reinterpret_cast<Function>(found);
    if (function == nullptr && missing.empty()) missing = fmt::format("libEGL has no {}", name);
}

Egl load_egl() {
    Egl egl;
    // Never closed: drivers keep threads and exit handlers of their own.
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        egl.missing = fmt::format("{} (on Debian: apt-get install libegl1)", dlerror());
        return egl;
    }
    const auto need = [&](auto& function, const char* name) {
        load(egl, library, function, name, egl.missing);
    };
    need(egl.get_proc_address, "eglGetProcAddress");
    need(egl.query_string, "eglQueryString");
    need(egl.get_error, "eglGetError");
    need(egl.initialize, "eglInitialize");
    need(egl.bind_api, "eglBindAPI");
    need(egl.choose_config, "eglChooseConfig");
    need(egl.create_context, "eglCreateContext");
    need(egl.make_current, "eglMakeCurrent");
    need(egl.destroy_context, "eglDestroyContext");
    need(egl.get_platform_display, "eglGetPlatformDisplayEXT");
    load(egl, library, egl.query_devices, "eglQueryDevicesEXT", egl.no_devices);
    load(egl, library, egl.query_device_string, "eglQueryDeviceStringEXT", egl.no_devices);
    return egl;
}

const Egl& egl_api() {
    static const Egl egl = load_egl();
    return egl;
}

const Egl& require_egl() {
    if (!egl_api().missing.empty()) throw GlError(egl_api().missing);
    return egl_api();
}

std::vector<EGLDeviceEXT> query_devices(const Egl& egl) {
    EGLint count = 0;
    if (egl.query_devices(0, nullptr, &count) == EGL_FALSE) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    egl.query_devices(count, devices.data(), &count);
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

// The software device also claims a DRM render node; only this extension tells it apart.
bool is_software(const Egl& egl, EGLDeviceEXT device) {
    const char* extensions = egl.query_device_string(device, EGL_EXTENSIONS);
    return extensions != nullptr &&
           std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
}

EGLDisplay open_display(const Egl& egl, const Candidate& candidate) {
    if (candidate.kind == ContextKind::EglSurfaceless) {
        return egl.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY,
                                        nullptr);
    }
    int number = 0;
    for (EGLDeviceEXT device : query_devices(egl)) {
        if (is_software(egl, device) != (candidate.kind == ContextKind::EglSoftware)) continue;
        if (number++ == candidate.device) {
            return egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        }
    }
    throw GlError(
        fmt::format("EGL lists {} such devices; there is no number {}", number, candidate.device));
}

class EglContext : public NativeContext {
  public:
    explicit EglContext(const Candidate& candidate) : egl_(require_egl()) {
        display_ = open_display(egl_, candidate);
        require(display_ != EGL_NO_DISPLAY, "eglGetPlatformDisplayEXT");
        require(egl_.initialize(display_, nullptr, nullptr) == EGL_TRUE, "eglInitialize");
        require(egl_.bind_api(EGL_OPENGL_API) == EGL_TRUE, "eglBindAPI(EGL_OPENGL_API)");
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        require(egl_.choose_config(display_, wanted, &config, 1, &count) == EGL_TRUE && count > 0,
                "eglChooseConfig for OpenGL");
        context_ = create(config, true);
        if (context_ == EGL_NO_CONTEXT) context_ = create(config, false);
        require(context_ != EGL_NO_CONTEXT, "eglCreateContext for OpenGL 4.5 core");
        if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
            const EGLint error = egl_.get_error();
            egl_.destroy_context(display_, context_);
            throw GlError(
                fmt::format("eglMakeCurrent without a surface failed (EGL error {:#06x})", error));
        }
    }

    // The display stays initialised: it is shared with any other user of this device in the
    // process.
    ~EglContext() override {
        egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl_.destroy_context(display_, context_);
    }

    void* find(const char* function) override {
        return reinterpret_cast<void*>(egl_.get_proc_address(function));
    }

  private:
    // One that tells of a reset of its GPU, where the driver can.
    EGLContext create(EGLConfig config, bool tells_reset) const {
        std::vector<EGLint> attributes{
            EGL_CONTEXT_MAJOR_VERSION,       4,
            EGL_CONTEXT_MINOR_VERSION,       5,
            EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
            EGL_CONTEXT_OPENGL_DEBUG,        EGL_TRUE};
        if (tells_reset) {
            attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                                 EGL_LOSE_CONTEXT_ON_RESET});
        }
        attributes.push_back(EGL_NONE);
        return egl_.create_context(display_, config, EGL_NO_CONTEXT, attributes.data());
    }

    void require(bool fine, const char* call) const {
        if (!fine)
            throw GlError(fmt::format("{} failed (EGL error {:#06x})", call, egl_.get_error()));
    }

    const Egl& egl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::vector<Candidate> list_egl_candidates(std::vector<FailedAttempt>& failed) {
    const Egl& egl = egl_api();
    if (!egl.missing.empty()) {
        failed.push_back({"EGL", egl.missing});
        return {};
    }
    std::vector<Candidate> candidates{
        {ContextKind::EglSurfaceless, -1, "EGL surfaceless platform"}};
    if (!egl.no_devices.empty()) {
        failed.push_back({"EGL devices", egl.no_devices});
        return candidates;
    }
    int hardware = 0;
    int software = 0;
    for (EGLDeviceEXT device : query_devices(egl)) {
        if (is_software(egl, device)) {
            candidates.push_back({ContextKind::EglSoftware, software,
                                  fmt::format("EGL software device {}", software)});
            ++software;
        } else {
            candidates.push_back({ContextKind::EglHardware, hardware,
                                  fmt::format("EGL hardware device {}", hardware)});
            ++hardware;
        }
    }
    return candidates;
}

std::unique_ptr<NativeContext> make_egl_context(const Candidate& candidate) {
    return std::make_unique<EglContext>(candidate);
}

}  // namespace zskel::gl
