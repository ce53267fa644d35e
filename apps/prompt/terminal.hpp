#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

namespace app {

/// Removes --quiet and --verbose from the words and applies them from then on. Throws rough::InputError if
/// both are given.
void parse_verbosity(std::vector<std::string>& words);

/// A text for a terminal, on one line: names from files may hold any character. Control characters (C0, C1,
/// those that change the direction of writing) and bytes outside UTF-8 become '?', breaks and tabs blanks.
std::string printable(const std::string& text);

void say(const std::string& remark);  ///< prints a line on standard output, unless --quiet
void tell(const std::string& detail); ///< prints a line on standard output, with --verbose only

/// A line on a terminal's stderr that shows the progress of a run of more than a second, cut at the
/// terminal's width. Nothing is written to a pipe.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;

    /// Shows a text, e.g. "gco: 12 of 40", at most ten times per second.
    void show(const std::string& text);

  private:
    using Clock = std::chrono::steady_clock;
    bool terminal_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// "45 s", or "12 min 5 s" from two minutes on.
std::string duration_words(double seconds);

/// While it exists, the first interrupt (Ctrl-C), request to end or hang-up asks the program to stop at the
/// next safe place. A second one ends the program at once. Signals that were ignored when the program began,
/// as under nohup, stay ignored.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    bool requested() const { return flag(); }
    static const std::atomic<bool>& flag(); ///< for the engine's budget
};

void ask_to_stop(); ///< as a signal does

constexpr int exit_interrupted = 130;

} // namespace app
