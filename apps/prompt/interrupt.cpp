#include "apps/prompt/interrupt.hpp"

#include <csignal>

namespace app {

namespace {

std::atomic<bool> stop_asked = false; // lock-free, so a signal handler may set it
static_assert(std::atomic<bool>::is_always_lock_free);

void ask(int signal) {
    stop_asked = true;
    std::signal(signal, SIG_DFL);
}

} // namespace

Interrupt::Interrupt() {
    stop_asked = false;
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
}

Interrupt::~Interrupt() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& Interrupt::flag() const { return stop_asked; }

} // namespace app
