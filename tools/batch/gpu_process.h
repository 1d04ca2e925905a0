#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace zskel::batch {

/// The one process of a batch that talks to a GPU, for all of its workers (gpu_server.h). Another
/// takes its place when it ends; workers that connect meanwhile wait for it.
class GpuProcess {
  public:
    /// @param launch  what the process does with the socket that workers connect to. @throws Error.
    explicit GpuProcess(std::function<void(int listening)> launch);
    ~GpuProcess();
    GpuProcess(const GpuProcess&) = delete;
    GpuProcess& operator=(const GpuProcess&) = delete;

    const std::string& address() const { return address_; }

    /// Starts it anew if it has ended. @throws Error.
    void tend();

    /// Starts it anew if it does not answer for some seconds, as when its driver hangs. @throws
    /// Error.
    void replace_if_hung();

  private:
    void start();
    void stop();
    bool answers() const;

    std::function<void(int)> launch_;
    std::string address_;
    int listening_ = -1;
    pid_t pid_ = -1;
};

}  // namespace zskel::batch
