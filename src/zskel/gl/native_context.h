#pragma once

#include <memory>
#include <string>
#include <vector>

#include "zskel/gl/context.h"

namespace zskel::gl {

/// A context as its window-system layer makes it: bound to the calling thread, without any check.
/// All calls come from one thread.
class NativeContext {
  public:
    virtual ~NativeContext() = default;
    /// Address of a GL function, or null.
    virtual void* find(const char* function) = 0;
};

/// One way to a context, not yet tried.
struct Candidate {
    ContextKind kind;
    int device = -1;
    std::string name;
};

/// The surfaceless platform, and the devices that EGL lists (nothing is initialised); what cannot
/// be had is in `failed` with the reason.
std::vector<Candidate> list_egl_candidates(std::vector<FailedAttempt>& failed);

/// Makes the candidate's context current on this thread. @throws GlError with the reason.
std::unique_ptr<NativeContext> make_egl_context(const Candidate& candidate);
std::unique_ptr<NativeContext> make_osmesa_context();

}  // namespace zskel::gl
