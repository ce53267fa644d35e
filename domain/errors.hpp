#pragma once

#include "domain/plain_stream.hpp"

#include <stdexcept>
#include <string>

namespace rough {

/// What the user gave cannot be used: one line that says what was given, what was expected, and where.
struct InputError : std::invalid_argument {
    /// `about` names the value at fault ("strip width"), so that a program can say which of its flags sets
    /// it.
    explicit InputError(const std::string& line, std::string about = "")
        : std::invalid_argument(line), about(std::move(about)) {}

    std::string about; ///< in words; empty where no single value is at fault
};

/// A solver ended without an answer that its certificate bears out.
struct NotConverged : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The parts of a line put together; numbers to nine digits.
template <typename... Parts>
std::string line_of(const Parts&... parts) {
    PlainStream line;
    line.precision(9);
    (line << ... << parts);
    return line.str();
}

/// Throws InputError with its parts put together.
template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    throw InputError(line_of(parts...));
}

/// Throws InputError about a value, with its name and ": " in front.
template <typename... Parts>
[[noreturn]] void refuse_value(const std::string& about, const Parts&... parts) {
    throw InputError(line_of(about, ": ", parts...), about);
}

} // namespace rough
