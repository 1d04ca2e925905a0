#include "batch/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace zskel::batch {
namespace {

constexpr std::size_t kBarWidth = 30;
constexpr std::chrono::milliseconds kPause(200);

std::string duration_text(double seconds) {
    const auto whole = std::lround(seconds);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string progress_text(const Tally& tally, double seconds) {
    const double share = tally.items == 0
                             ? 1.0
                             : static_cast<double>(tally.done()) / static_cast<double>(tally.items);
    const auto filled = static_cast<std::size_t>(share * kBarWidth);
    std::string text = fmt::format("[{:<{}}] {}/{} {:.0f} %", std::string(filled, '#'), kBarWidth,
                                   tally.done(), tally.items, share * 100.0);
    if (tally.worked_on() > 0 && seconds > 0.0) {
        const double rate = static_cast<double>(tally.worked_on()) / seconds;
        text += fmt::format(", {:.1f}/s, {} left", rate,
                            duration_text(static_cast<double>(tally.items - tally.done()) / rate));
    }
    if (tally.failed > 0) text += fmt::format(", {} failed", tally.failed);
    return text;
}

ProgressLine::ProgressLine(bool wanted) : shown_(wanted && ::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const Tally& tally) {
    const Clock::time_point now = Clock::now();
    if (!shown_ || (drawn_ && now - last_ < kPause)) return;
    const std::string line =
        "\r\033[K" + progress_text(tally, std::chrono::duration<double>(now - start_).count());
    std::fputs(line.c_str(), stderr);
    drawn_ = true;
    last_ = now;
}

}  // namespace zskel::batch
