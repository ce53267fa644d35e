#pragma once

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

} // namespace rough
