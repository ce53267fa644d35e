#include "apps/prompt/verbosity.hpp"

#include "apps/prompt/progress.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
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

} // namespace app
