#pragma once

#include <array>
#include <csignal>
#include <cstddef>

namespace zskel::batch {

/// While it lives, SIGINT, SIGTERM and SIGHUP are noted down and do nothing else; what was done
/// about them before comes back at its end. One at a time.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The first that came; 0: none.
    int first() const;
    /// How many came.
    int count() const;
    /// Can be read from as long as one came that `forget_wake` was not called after.
    int wake_fd() const;
    void forget_wake();

  private:
    static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace zskel::batch
