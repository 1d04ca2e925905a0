#pragma once

#include <memory>
#include <string>

/// A GL context that belongs to this program, current on the thread that opened it, with state of
/// its own.
class CallerContext {
  public:
    /// Null when EGL gives no context here.
    static std::unique_ptr<CallerContext> open();
    virtual ~CallerContext() = default;

    /// What is current on this thread, the GL state set by `open`, and a texel drawn then, as text.
    virtual std::string state() const = 0;
};
