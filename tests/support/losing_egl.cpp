// Stands in for libEGL.so.1: the real one, but that one context of the process is lost, as after a
// reset of the GPU, when its state is asked for the ZSKEL_LOSE_AFTER-th time.
#include <EGL/egl.h>
#include <GL/glcorearb.h>
#include <dlfcn.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Address = __eglMustCastToProperFunctionPointerType;

Address find(const char* name) {
    static void* const library = dlopen(ZSKEL_REAL_EGL, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return nullptr;
    static const auto real =
        reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(dlsym(library, "eglGetProcAddress"));
    return real(name);
}

GLenum APIENTRY reset_status() {
    static std::atomic<int> left = std::atoi(std::getenv("ZSKEL_LOSE_AFTER"));
    if (--left != 0) return GL_NO_ERROR;
    std::fputs("losing_egl: lost\n", stderr);
    return GL_UNKNOWN_CONTEXT_RESET;
}

}  // namespace

extern "C" Address eglGetProcAddress(const char* name) {
    if (std::strcmp(name, "glGetGraphicsResetStatus") == 0)
        return reinterpret_cast<Address>(reset_status);
    return find(name);
}
