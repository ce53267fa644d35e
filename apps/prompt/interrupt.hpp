#pragma once

#include <atomic>

namespace app {

/// From its construction on, the first interrupt (Ctrl-C) or request to end asks the program to stop at the
/// next safe place; a second one ends it at once.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    bool asked() const { return flag(); }
    const std::atomic<bool>& flag() const; ///< for the engine's budget
};

constexpr int exit_interrupted = 130;

} // namespace app
