#include "apps/prompt/interrupt.hpp"

#include <array>
#include <csignal>

namespace app {

namespace {

std::atomic<bool> asked_to_stop = false; // lock-free, so a signal handler may set it
static_assert(std::atomic<bool>::is_always_lock_free);

void ask(int signal) {
    asked_to_stop = true;
    std::signal(signal, SIG_DFL);
}

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};

} // namespace

Interrupt::Interrupt() {
    asked_to_stop = false;
    for (const int signal : signals)
        if (std::signal(signal, ask) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

Interrupt::~Interrupt() {
    for (const int signal : signals)
        if (std::signal(signal, SIG_DFL) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

const std::atomic<bool>& Interrupt::flag() { return asked_to_stop; }

bool stop_asked() { return asked_to_stop; }
void ask_to_stop() { asked_to_stop = true; }

} // namespace app
