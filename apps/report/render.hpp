#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace app {

/// The values of a page and where the rest of it is.
struct PageSource {
    nlohmann::json values;        ///< of result.json; its `kind` names the template
    std::filesystem::path folder; ///< of the tables NAME.csv
    std::string prefix = {};      ///< before the names of the tables, e.g. "curve-" beside curve.json
};

/// How pages are rendered.
struct Rendering {
    std::filesystem::path templates = {}; ///< folder of files used instead of the built-in ones; "": none
    double seconds = 600;                 ///< for all pictures, at most
};

/// Renders KIND.mustache of apps/report/templates: one self-contained page in light and dark.
///
/// A tag is looked up in the values, with these additions:
/// - `{{#tables.NAME}}` repeats for each row of NAME.csv; a cell is found by the name of its column;
/// - `{{{figures.NAME}}}` is the picture that apps/report/figures/NAME.gp draws from the tables. Behind a
/// colon
///   stands the script's variable `arg`: `figures.NAME:TEXT`; `@KEY` at its end is replaced by a value;
/// - `{{KEY|FILTER}}` formats a value. Numbers: `3` (digits, the default), `percent`, `brief`, `length` (from
///   mm) and `pressure` (from MPa) with the unit that suits. Conditions for sections: `is:TEXT`, `above:X`,
///   `below:X`. `address` makes a path an address of a link. Lists and objects: `count`, `some` (a
///   condition), and `by` (sides: "20 x 18"), `items`, the entries of an object, each with its `key`. In a
///   loop `row` is its number, from 1, and `more` is true unless it is the last.
///
/// Throws rough::InputError if the kind has no template, a template cannot be parsed, or a table cannot be
/// read.
std::string render(const PageSource& source, const Rendering& rendering = {});

/// A picture as an SVG document. `figure` is written as after `figures.` in a template. Throws
/// rough::InputError if it cannot be drawn.
std::string figure_file(const std::string& figure, const PageSource& source, const Rendering& rendering = {});

/// The source of a folder (result.json, profile.json or surface.json and its tables), or of a file CURVE.json
/// with its tables CURVE-NAME.csv. Throws rough::InputError.
PageSource page_source(const std::filesystem::path& place);

/// Where the page of a source is written: CURVE.html beside CURVE.json; else in the folder chart.html or
/// stability.html of these kinds, report.html of others.
std::filesystem::path page_of(const PageSource& source);

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
