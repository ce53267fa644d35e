#include "apps/prompt/progress.hpp"

#include "apps/prompt/voice.hpp"

#include <cmath>
#include <iostream>
#include <unistd.h>

namespace app {

namespace {
constexpr const char* clear_line = "\r\033[K";
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0 && voice() != Voice::quiet) {}

Progress::~Progress() {
    if (shown_)
        std::cerr << clear_line << std::flush;
}

void Progress::show(const std::string& text) {
    const auto now = Clock::now();
    using namespace std::chrono_literals;
    if (!terminal_ || now - start_ < 1s || (shown_ && now - last_ < 100ms))
        return;
    std::cerr << clear_line << std::chrono::duration_cast<std::chrono::seconds>(now - start_).count()
              << " s  " << text << std::flush;
    shown_ = true;
    last_ = now;
}

std::string duration_words(double seconds) {
    const long whole = std::lround(seconds);
    return whole < 120 ? std::to_string(whole) + " s"
                       : std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

} // namespace app
