#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

namespace app {

/// Removes --quiet and --verbose from the words and applies them from then on. Throws rough::InputError on
/// both.
void parse_verbosity(std::vector<std::string>& words);

void say(const std::string& remark);  ///< a line on standard output, unless --quiet
void tell(const std::string& detail); ///< a line on standard output, with --verbose alone

/// What begins an error's line: "rugosa: ", in red where stderr is a terminal (and NO_COLOR is not set).
std::string error_mark();

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

/// From its construction on, the first interrupt (Ctrl-C), request to end or hang-up asks the program to stop
/// at the next safe place; a second one ends it at once. A signal that was ignored when the program began, as
/// nohup has it, stays ignored.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    bool asked() const { return flag(); }
    static const std::atomic<bool>& flag(); ///< for the engine's budget
};

/// Whether a stop was asked for: for what has no Interrupt at hand.
bool stop_asked();
void ask_to_stop(); ///< as a signal would

constexpr int exit_interrupted = 130;

} // namespace app
