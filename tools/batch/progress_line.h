#pragma once

#include <chrono>
#include <string>

#include "batch/tally.h"

namespace zskel::batch {

/// How far a batch is, with its rate and the time that is left at that rate. Items that an earlier
/// run has done do not count towards the rate.
std::string progress_text(const Tally& tally, double seconds);

/// That line, drawn over itself on standard error a few times a second, if that is a terminal; it
/// goes away at the end.
class ProgressLine {
  public:
    explicit ProgressLine(bool wanted);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(const Tally& tally);

  private:
    using Clock = std::chrono::steady_clock;
    bool shown_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_;
};

}  // namespace zskel::batch
