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
    static const std::atomic<bool>& flag(); ///< for the engine's budget
};

/// Whether a stop was asked for: for what has no Interrupt at hand.
bool stop_asked();
void ask_to_stop(); ///< as a signal would

constexpr int exit_interrupted = 130;

} // namespace app
