#pragma once

#include <string>
#include <vector>

namespace app {

/// How much the program says beside its results.
enum class Voice { quiet, plain, verbose };

/// Takes --quiet and --verbose out of the words and keeps to them from then on. Throws rough::InputError on
/// both.
void parse_verbosity(std::vector<std::string>& words);
Voice voice();

void say(const std::string& remark);  ///< a line on standard output, unless --quiet
void tell(const std::string& detail); ///< a line on standard output, with --verbose alone

/// What begins an error's line: "rugosa: ", in red where stderr is a terminal (and NO_COLOR is not set).
std::string error_mark();

} // namespace app
