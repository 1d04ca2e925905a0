#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/gl/context.h"
#include "zskel/visibility/choose.h"
#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// Where visibility comes from.
enum class BackendKind {
    Auto,  ///< the least predicted time: the CPU's Z-buffer, or a GPU; GL when one is asked for by
           ///< its number
    Gl,    ///< the first GL context that works
    Egl,   ///< the same, without OSMesa
    Osmesa,
    Cpu,    ///< our own Z-buffer, no GL
    Ray,    ///< Embree
    Brute,  ///< every ray against every triangle, as the paper did: for comparison only
};
/// @throws UsageError for an unknown name.
BackendKind parse_backend(std::string_view name);
std::string_view name_of(BackendKind kind);

struct BackendOptions {
    BackendKind kind = BackendKind::Auto;
    int gpu = -1;        ///< number of the hardware device to take; -1: any
    int face_px = 0;     ///< texels along a cube face; 0: 16, or what the method needs, see
                         ///< backend_options_for
    bool exact = false;  ///< the CPU's Z-buffer: no coarser levels of large solids
    int rays = 0;   ///< ray backends only: directions an eye, spread radially; 0: the cube's texels
    Workload work;  ///< what Auto weighs
};

/// Whether it is GL in any case; Auto without a GPU's number decides by the work.
bool uses_gl(const BackendOptions& options);

/// What answers, and why others did not.
struct BackendInfo {
    std::string name;  ///< egl-hardware, egl-software, egl-surfaceless, osmesa, cpu, ray, brute
    std::string vendor;
    std::string renderer;
    std::string version;
    std::string reason;                     ///< why Auto took it; empty where it was asked for
    std::vector<gl::FailedAttempt> failed;  ///< candidates tried before it
    bool is_raster = false;                 ///< a Z-buffer, not rays
    bool has_levels = false;                ///< large solids are seen by coarser levels too
};

/// An opened backend: prepares one source a solid. Sources must not outlive it. One call at a time,
/// to the backend and its sources together, from whichever thread: GL sources share its buffers.
/// Threads that work at once open a backend each.
class Backend {
  public:
    virtual ~Backend() = default;
    virtual std::unique_ptr<VisibilitySource> prepare(const Surface& solid) = 0;

    /// What `look` of each of its sources would do, in one batch where the backend has batches:
    /// small solids fill a GPU together. @throws GlError when a GL pass fails.
    virtual void look(std::span<const Look> looks);

    const BackendInfo& info() const { return info_; }

  protected:
    explicit Backend(BackendInfo info) : info_(std::move(info)) {}

  private:
    BackendInfo info_;
};

/// @throws UsageError for options that make no sense together.
void check_backend_options(const BackendOptions& options);

/// @throws GlError when the backend asked for cannot be had (one named never falls back), with
/// every
///         candidate's reason; UsageError for options that make no sense together.
std::unique_ptr<Backend> open_backend(const BackendOptions& options);

/// A GPU by GL and no software in its place. @throws GlError when none can be used.
std::unique_ptr<Backend> open_gpu(const BackendOptions& options);

/// A context for pictures: any that works. @throws GlError when there is none, with every reason.
std::unique_ptr<gl::Context> open_picture_context(int gpu = -1);

}  // namespace zskel
