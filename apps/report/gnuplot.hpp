#pragma once

#include <string>

namespace app {

/// What gnuplot made of a script.
struct Drawn {
    std::string pictures; ///< its standard output, one SVG document after another
    std::string failure;  ///< why it made none, in a few words; "" where it did
};

/// Runs gnuplot on a script for at most so many seconds: no shell, no start-up file of the user's, no file on
/// the disk. It and what it started are ended when the time is over.
Drawn run_gnuplot(const std::string& script, double seconds);

/// A text as gnuplot's string that is this text and nothing else: whatever could end it, be expanded or be
/// run is written by its number.
std::string gnuplot_text(const std::string& text);

} // namespace app
