#pragma once

#include <sstream>
#include <stdexcept>

namespace rough {

/// What the user gave cannot be used: one line that says what was given, what was expected, and where.
struct InputError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// A solver ended without an answer that its certificate bears out.
struct NotConverged : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws InputError with its parts put together; numbers to nine digits.
template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    std::ostringstream line;
    line.precision(9);
    (line << ... << parts);
    throw InputError(line.str());
}

} // namespace rough
