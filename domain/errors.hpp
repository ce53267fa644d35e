#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace rough {

/// A text stream that writes numbers with a decimal point and without grouping in every locale.
struct PlainStream : std::ostringstream {
    PlainStream() { imbue(std::locale::classic()); }
};

/// An input that cannot be used. The message is one line: place, problem and fix.
struct InputError : std::invalid_argument {
    /// `about` names the value at fault ("strip width"), so that a program can name the flag that sets it.
    explicit InputError(const std::string& line, std::string about = "")
        : std::invalid_argument(line), about(std::move(about)) {}

    std::string about; ///< in words; empty unless a single value is at fault
};

/// A solver ended without a solution that its certificate confirms.
struct NotConverged : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The parts joined to a line; numbers have `digits` digits.
template <typename... Parts>
std::string line_with_digits(int digits, const Parts&... parts) {
    PlainStream line;
    line.precision(digits);
    (line << ... << parts);
    return line.str();
}

/// The parts joined to a line; numbers have nine digits.
template <typename... Parts>
std::string line_of(const Parts&... parts) {
    return line_with_digits(9, parts...);
}

/// Throws InputError with the parts joined to a line.
template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    throw InputError(line_of(parts...));
}

/// Throws InputError about a value; its name and ": " precede the parts.
template <typename... Parts>
[[noreturn]] void refuse_value(const std::string& about, const Parts&... parts) {
    throw InputError(line_of(about, ": ", parts...), about);
}

} // namespace rough
