#pragma once

#include <stdexcept>
#include <string>

namespace ga {

/// A pipeline or option that cannot work. The message is one line with place, problem and fix.
struct UsageError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// An error in a text, with the text's name ("pipeline", "variant 'sog'") and the column, from 1.
struct TextError : UsageError {
    /// An error with the message "where, column N: message".
    TextError(const std::string& where, std::size_t column, const std::string& message)
        : UsageError(where + ", column " + std::to_string(column) + ": " + message) {}
};

/// Throws UsageError if the content of a checkpoint does not fit its pipeline.
inline void expect_fit(bool fits) {
    if (!fits) throw UsageError("the checkpoint does not fit its pipeline; use one that this pipeline has written");
}

/// Ends a run through its stages, because a limit is reached or it cannot continue; `run` catches it.
struct Stopped {
    std::string reason;       ///< "time budget spent", "stop requested", ...
    bool is_dead_end = false; ///< whether the run cannot continue, e.g. because a selection is empty
};

} // namespace ga
