#pragma once

#include <atomic>

namespace app {

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
    const std::atomic<bool>& flag() const; ///< for the engine's budget
};

/// Whether a stop was asked for: for what has no Interrupt at hand.
bool stop_asked();

constexpr int exit_interrupted = 130;

} // namespace app
