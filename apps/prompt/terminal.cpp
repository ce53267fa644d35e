#include "apps/prompt/terminal.hpp"

#include "domain/errors.hpp"

#include <boost/locale/utf.hpp>

#include <cmath>
#include <csignal>
#include <iostream>
#include <unistd.h>

namespace app {
namespace {

enum class Verbosity { quiet, plain, verbose };
Verbosity verbosity = Verbosity::plain;

constexpr const char* clear_line = "\r\033[K";
/// A line longer than the terminal's width is cut. If it wrapped, its first part would stay.
constexpr const char *no_wrap = "\033[?7l", *wrap = "\033[?7h";
std::atomic<bool> stands = false;

/// Removes the line of progress, if there is one, before other output.
void clear_progress() {
    if (stands.exchange(false)) std::cerr << clear_line << std::flush;
}

std::atomic<bool> asked_to_stop = false; // lock-free, so that a signal handler may set it
static_assert(std::atomic<bool>::is_always_lock_free);

void ask(int signal) {
    asked_to_stop = true;
    std::signal(signal, SIG_DFL);
}

/// Handles the signals that ask to stop, except those that are ignored.
void handle(void (*handler)(int)) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

} // namespace

void parse_verbosity(std::vector<std::string>& words) {
    const bool quiet = std::erase(words, "--quiet") > 0, verbose = std::erase(words, "--verbose") > 0;
    if (quiet && verbose) rough::refuse("--quiet and --verbose given; give one of them");
    verbosity = quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::plain;
}

std::string printable(const std::string& text) {
    namespace utf = boost::locale::utf;
    std::string line;
    for (auto at = text.begin(); at != text.end();) {
        const auto begin = at;
        const utf::code_point c = utf::utf_traits<char>::decode(at, text.end());
        const bool redirects = (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
        if (c == '\n' || c == '\r' || c == '\t')
            line += ' ';
        else if (!utf::is_valid_codepoint(c) || c < ' ' || (c >= 0x7f && c < 0xa0) || redirects)
            line += '?';
        else
            line.append(begin, at);
    }
    return line;
}

void say(const std::string& remark) {
    if (verbosity == Verbosity::quiet) return;
    clear_progress();
    std::cout << printable(remark) << "\n";
}

void tell(const std::string& detail) {
    if (verbosity == Verbosity::verbose) say(detail);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0 && verbosity != Verbosity::quiet) {}

ProgressLine::~ProgressLine() { clear_progress(); }

void ProgressLine::show(const std::string& text) {
    const auto now = Clock::now();
    using namespace std::chrono_literals;
    if (!terminal_ || now - start_ < 1s || (stands && now - last_ < 100ms)) return;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now - start_).count();
    std::cerr << clear_line << no_wrap << seconds << " s  " << printable(text) << wrap << std::flush;
    stands = true;
    last_ = now;
}

std::string duration_words(double seconds) {
    const long whole = std::lround(seconds);
    return whole < 120 ? std::to_string(whole) + " s"
                       : std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

Interrupt::Interrupt() {
    asked_to_stop = false;
    handle(ask);
}

Interrupt::~Interrupt() { handle(SIG_DFL); }

const std::atomic<bool>& Interrupt::flag() { return asked_to_stop; }

void ask_to_stop() { asked_to_stop = true; }

} // namespace app
