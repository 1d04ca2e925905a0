#pragma once

#include <stdexcept>
#include <string>

namespace zskel {

/// Exit codes of the command-line program; each error type carries its own.
enum class ExitCode {
    Ok = 0,
    Internal = 1,
    Usage = 2,
    Input = 3,
    Backend = 4,
    Io = 5,
    Check = 6,
    Limit = 7
};

/// Base of everything that zskel throws; the text names the file or element and says what to do.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// An option or argument that makes no sense.
class UsageError : public Error {
  public:
    explicit UsageError(const std::string& text) : Error(ExitCode::Usage, text) {}
};

/// A model that cannot be read or used.
class InputError : public Error {
  public:
    explicit InputError(const std::string& text) : Error(ExitCode::Input, text) {}
};

/// No usable backend, or a GL pass that failed; the text names the stage.
class GlError : public Error {
  public:
    explicit GlError(const std::string& text) : Error(ExitCode::Backend, text) {}
};

/// A file that cannot be written.
class IoError : public Error {
  public:
    explicit IoError(const std::string& text) : Error(ExitCode::Io, text) {}
};

/// More time, memory or faces than were allowed, or more memory than there is.
class LimitError : public Error {
  public:
    explicit LimitError(const std::string& text) : Error(ExitCode::Limit, text) {}
};

/// Of these: more memory than there is.
class MemoryError : public LimitError {
  public:
    using LimitError::LimitError;
};

}  // namespace zskel
