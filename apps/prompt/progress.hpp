#pragma once

#include <chrono>
#include <string>

namespace app {

/// A line on a terminal's stderr that is written over while a run takes longer than a second, cut at the
/// terminal's width; nothing when piped.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;

    /// What is being done, e.g. "gco: 12 of 40"; shown at most ten times a second.
    void show(const std::string& text);

  private:
    using Clock = std::chrono::steady_clock;
    bool terminal_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// Takes away the line where one stands, so that what is said next does not stick to it.
void clear_progress();

/// "45 s", or "12 min 5 s" from two minutes on.
std::string duration_words(double seconds);

} // namespace app
