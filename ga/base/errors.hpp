#pragma once

#include <stdexcept>
#include <string>

namespace ga {

/// A pipeline or option that cannot work: one line that says what was given, what was expected, and where.
struct UsageError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// Where a text goes wrong: what it is called ("pipeline", "variant 'sog'"), and the column, from 1.
struct TextError : UsageError {
    /// "where, column N: message".
    TextError(const std::string& where, std::size_t column, const std::string& message)
        : UsageError(where + ", column " + std::to_string(column) + ": " + message) {}
};

/// Throws UsageError where what was read from a checkpoint is not what its pipeline would have written.
inline void expect_fit(bool fits) {
    if (!fits)
        throw UsageError("the checkpoint does not fit its pipeline; expected one that was written by it");
}

/// A selection left nobody, or every evaluation of a run failed: there is nothing to go on with.
struct NothingLeft : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Thrown through the stages when a budget is spent or a stop was asked for; `run` turns it into a result.
struct Stopped {
    std::string reason; ///< "time budget spent", "stop requested", ...
};

} // namespace ga
