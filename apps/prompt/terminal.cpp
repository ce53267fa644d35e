#include "apps/prompt/terminal.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace app {

namespace {

Voice& kept() {
    static Voice voice = Voice::plain;
    return voice;
}

bool taken(std::vector<std::string>& words, const char* word) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
        return false;
    words.erase(found);
    return true;
}

} // namespace

void parse_verbosity(std::vector<std::string>& words) {
    const bool quiet = taken(words, "--quiet"), verbose = taken(words, "--verbose");
    if (quiet && verbose)
        throw rough::InputError("--quiet and --verbose given, expected one of them");
    kept() = quiet ? Voice::quiet : verbose ? Voice::verbose : Voice::plain;
}

Voice voice() { return kept(); }

void say(const std::string& remark) {
    if (voice() == Voice::quiet)
        return;
    clear_progress();
    std::cout << remark << "\n";
}

void tell(const std::string& detail) {
    if (voice() == Voice::verbose)
        say(detail);
}

std::string error_mark() {
    return isatty(STDERR_FILENO) && !std::getenv("NO_COLOR") ? "\033[31mrugosa:\033[0m " : "rugosa: ";
}

namespace {
constexpr const char* clear_line = "\r\033[K";
std::atomic<bool> stands = false;

/// What fits into a terminal's line: a longer one would wrap, and its first part stay.
std::string cut(std::string text) {
    winsize size{};
    constexpr std::size_t usual = 80;
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    std::size_t left = (known ? size.ws_col : usual) - 1, at = 0;
    for (; at < text.size(); ++at) {
        const bool begins = (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80; // a letter of UTF-8
        if (begins && left-- == 0)
            break;
    }
    text.resize(at);
    return text;
}
} // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0 && voice() != Voice::quiet) {}

Progress::~Progress() { clear_progress(); }

void clear_progress() {
    if (stands.exchange(false))
        std::cerr << clear_line << std::flush;
}

void Progress::show(const std::string& text) {
    const auto now = Clock::now();
    using namespace std::chrono_literals;
    if (!terminal_ || now - start_ < 1s || (stands && now - last_ < 100ms))
        return;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now - start_).count();
    std::cerr << clear_line << cut(std::to_string(seconds) + " s  " + text) << std::flush;
    stands = true;
    last_ = now;
}

std::string duration_words(double seconds) {
    const long whole = std::lround(seconds);
    return whole < 120 ? std::to_string(whole) + " s"
                       : std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

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
