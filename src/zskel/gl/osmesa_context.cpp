// Mesa's off-screen library. Mesa 25.1 removed it, so it is looked for at run time and never
// required; the few constants of its interface that are used stand here, since its header may be
// gone too.
#include <dlfcn.h>
#include <fmt/format.h>

#include <array>

#include "zskel/core/error.h"
#include "zskel/gl/api.h"
#include "zskel/gl/native_context.h"

namespace zskel::gl {
namespace {

constexpr int kOsmesaFormat = 0x22;
constexpr int kOsmesaProfile = 0x33;
constexpr int kOsmesaCoreProfile = 0x34;
constexpr int kOsmesaContextMajor = 0x36;
constexpr int kOsmesaContextMinor = 0x37;
constexpr int kRgba = 0x1908;

using OsmesaHandle = void*;

struct Osmesa {
    OsmesaHandle (*create_context)(const int* attributes, OsmesaHandle share) = nullptr;
    void (*destroy_context)(OsmesaHandle context) = nullptr;
    GLboolean (*make_current)(OsmesaHandle context, void* buffer, GLenum type, GLsizei width,
                              GLsizei height) = nullptr;
    void* (*get_proc_address)(const char* name) = nullptr;
};

Osmesa load_osmesa() {
    void* library = nullptr;
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
        library = dlopen(name, RTLD_NOW | RTLD_LOCAL);  // never closed, as libEGL
        if (library != nullptr) break;
    }
    if (library == nullptr)
        throw GlError("libOSMesa is not installed (on Debian: apt-get install libosmesa6)");
    Osmesa osmesa;
    const auto load = [&](auto& function, const char* name) {
        function =
            reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
        if (function == nullptr) throw GlError(fmt::format("libOSMesa has no {}", name));
    };
    load(osmesa.create_context, "OSMesaCreateContextAttribs");
    load(osmesa.destroy_context, "OSMesaDestroyContext");
    load(osmesa.make_current, "OSMesaMakeCurrent");
    load(osmesa.get_proc_address, "OSMesaGetProcAddress");
    return osmesa;
}

class OsmesaContext : public NativeContext {
  public:
    OsmesaContext() : osmesa_(load_osmesa()) {
        const int attributes[] = {kOsmesaFormat,
                                  kRgba,
                                  kOsmesaProfile,
                                  kOsmesaCoreProfile,
                                  kOsmesaContextMajor,
                                  4,
                                  kOsmesaContextMinor,
                                  5,
                                  0};
        context_ = osmesa_.create_context(attributes, nullptr);
        if (context_ == nullptr)
            throw GlError("OSMesaCreateContextAttribs gives no OpenGL 4.5 core context");
        if (osmesa_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
            osmesa_.destroy_context(context_);
            throw GlError("OSMesaMakeCurrent failed");
        }
    }
    ~OsmesaContext() override {
        osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        osmesa_.destroy_context(context_);
    }
    void* find(const char* function) override { return osmesa_.get_proc_address(function); }

  private:
    Osmesa osmesa_;
    OsmesaHandle context_ = nullptr;
    std::array<unsigned char, 4> pixel_{};  // the default framebuffer that OSMesa insists on
};

}  // namespace

std::unique_ptr<NativeContext> make_osmesa_context() {
    return std::make_unique<OsmesaContext>();
}

}  // namespace zskel::gl
