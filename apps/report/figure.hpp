#pragma once

#include <string>

namespace app {

/// A picture to draw: a gnuplot script, and what it is given.
struct FigureScript {
    std::string script;   ///< its first line is a comment that says what there is to see
    std::string style;    ///< is run before it
    std::string tables;   ///< gnuplot's `tables`: stands before the names of the tables
    std::string argument; ///< gnuplot's `arg`
    std::string name;     ///< begins the ids in the picture: letters and digits
    double seconds = 60;  ///< in which it is drawn, at most
};

/// The picture as an <svg> element whose colours are variables of the page, or a paragraph that says why
/// there is none. Runs gnuplot without a shell, without a start-up file and without a file on the disk.
std::string figure_svg(const FigureScript& figure);

/// The picture as an SVG document with fixed colours. Throws rough::InputError if gnuplot does not draw it.
std::string figure_document(const FigureScript& figure);

} // namespace app
