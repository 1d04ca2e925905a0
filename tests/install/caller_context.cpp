#include "caller_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <array>
#include <sstream>
#include <utility>
#include <vector>

namespace {

template <typename Function>
Function find(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> all;
    const auto query_devices = find<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto open = find<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (open == nullptr) return all;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices != nullptr) {
        query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    }
    for (EGLint i = 0; i < count; ++i) {
        all.push_back(open(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    }
    all.push_back(open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return all;
}

EGLContext make_current(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE ||
        eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
        return EGL_NO_CONTEXT;
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count == 0)
        return EGL_NO_CONTEXT;
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT) return EGL_NO_CONTEXT;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE)
        return context;
    eglDestroyContext(display, context);
    return EGL_NO_CONTEXT;
}

struct Value {
    const char* name;
    GLenum what;
    std::size_t count;
};
constexpr Value kValues[] = {{"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING, 1},
                             {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING, 1},
                             {"viewport", GL_VIEWPORT, 4},
                             {"scissor", GL_SCISSOR_BOX, 4},
                             {"active texture", GL_ACTIVE_TEXTURE, 1},
                             {"texture", GL_TEXTURE_BINDING_2D, 1},
                             {"buffer", GL_ARRAY_BUFFER_BINDING, 1},
                             {"vertex array", GL_VERTEX_ARRAY_BINDING, 1},
                             {"program", GL_CURRENT_PROGRAM, 1},
                             {"depth test", GL_DEPTH_TEST, 1},
                             {"depth function", GL_DEPTH_FUNC, 1},
                             {"culling", GL_CULL_FACE, 1},
                             {"blending", GL_BLEND, 1},
                             {"pack alignment", GL_PACK_ALIGNMENT, 1}};

class EglCaller : public CallerContext {
  public:
    EglCaller(EGLDisplay display, EGLContext context) : display_(display), context_(context) {
        set_state();
    }
    ~EglCaller() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }

    std::string state() const override {
        std::ostringstream out;
        out << "context " << (eglGetCurrentContext() == context_ ? "ours" : "another")
            << ", display " << (eglGetCurrentDisplay() == display_ ? "ours" : "another") << ", API "
            << eglQueryAPI();
        for (const Value& value : kValues) {
            std::array<GLint, 4> found{};
            find<PFNGLGETINTEGERVPROC>("glGetIntegerv")(value.what, found.data());
            out << ", " << value.name;
            for (std::size_t i = 0; i < value.count; ++i) out << ' ' << found[i];
        }
        std::array<unsigned char, 4> texel{};
        find<PFNGLREADPIXELSPROC>("glReadPixels")(3, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                                                  texel.data());
        out << ", texel";
        for (const unsigned char part : texel) out << ' ' << int{part};
        out << ", error " << find<PFNGLGETERRORPROC>("glGetError")();
        return out.str();
    }

  private:
    // Nothing as a fresh context has it, nor as zskel would set it.
    static void set_state() {
        GLuint texture = 0;
        find<PFNGLGENTEXTURESPROC>("glGenTextures")(1, &texture);
        find<PFNGLACTIVETEXTUREPROC>("glActiveTexture")(GL_TEXTURE3);
        find<PFNGLBINDTEXTUREPROC>("glBindTexture")(GL_TEXTURE_2D, texture);
        find<PFNGLTEXIMAGE2DPROC>("glTexImage2D")(GL_TEXTURE_2D, 0, GL_RGBA8, 7, 5, 0, GL_RGBA,
                                                  GL_UNSIGNED_BYTE, nullptr);
        GLuint framebuffer = 0;
        find<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers")(1, &framebuffer);
        find<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer);
        find<PFNGLFRAMEBUFFERTEXTURE2DPROC>("glFramebufferTexture2D")(
            GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        GLuint buffer = 0;
        find<PFNGLGENBUFFERSPROC>("glGenBuffers")(1, &buffer);
        find<PFNGLBINDBUFFERPROC>("glBindBuffer")(GL_ARRAY_BUFFER, buffer);
        GLuint vertex_array = 0;
        find<PFNGLGENVERTEXARRAYSPROC>("glGenVertexArrays")(1, &vertex_array);
        find<PFNGLBINDVERTEXARRAYPROC>("glBindVertexArray")(vertex_array);
        find<PFNGLVIEWPORTPROC>("glViewport")(1, 2, 6, 4);
        find<PFNGLSCISSORPROC>("glScissor")(2, 1, 5, 3);
        find<PFNGLENABLEPROC>("glEnable")(GL_CULL_FACE);
        find<PFNGLENABLEPROC>("glEnable")(GL_BLEND);
        find<PFNGLDEPTHFUNCPROC>("glDepthFunc")(GL_LEQUAL);
        find<PFNGLPIXELSTOREIPROC>("glPixelStorei")(GL_PACK_ALIGNMENT, 1);
        find<PFNGLCLEARCOLORPROC>("glClearColor")(0.2f, 0.4f, 0.6f, 0.8f);
        find<PFNGLCLEARPROC>("glClear")(GL_COLOR_BUFFER_BIT);
    }

    EGLDisplay display_;
    EGLContext context_;
};

}  // namespace

std::unique_ptr<CallerContext> CallerContext::open() {
    for (EGLDisplay display : displays()) {
        EGLContext context = make_current(display);
        if (context != EGL_NO_CONTEXT) return std::make_unique<EglCaller>(display, context);
    }
    return nullptr;
}
