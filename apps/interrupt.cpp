#include "apps/interrupt.hpp"

#include <csignal>

namespace app {

namespace {

volatile std::sig_atomic_t stop_asked = 0;

void ask(int signal) {
    stop_asked = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

Interrupt::Interrupt() {
    stop_asked = 0;
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
}

Interrupt::~Interrupt() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool Interrupt::asked() const { return stop_asked != 0; }

} // namespace app
