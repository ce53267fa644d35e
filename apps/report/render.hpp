#pragma once

#include "ga/base/json.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace app {

/// The values of a page and the place of its tables.
struct PageSource {
    nlohmann::json values;        ///< content of result.json; its `kind` names the template
    std::filesystem::path folder; ///< folder of the tables NAME.csv
    std::string prefix = {};      ///< beginning of their names, e.g. "curve-" for curve.json
};

/// Options of rendering.
struct Rendering {
    std::filesystem::path templates = {};     ///< folder of files used instead of the built-in ones; "": none
    double seconds = 600;                     ///< maximum time for all pictures; 0: none is drawn
    std::set<std::string>* missing = nullptr; ///< gets the tags whose keys the values do not have
};

/// Renders KIND.mustache of apps/report/templates or of an experiment: one self-contained page in light and dark.
///
/// A tag is looked up in the values. There are also these tags:
/// - `{{#tables.NAME}}` repeats for each row of NAME.csv. The tag of a cell is the name of its column.
/// - `{{{figures.NAME}}}` is the picture that NAME.gp draws from the tables. In
///   `figures.NAME:TEXT`, TEXT is the script's variable `arg`; `@KEY` at its end is replaced by a value.
/// - `{{KEY|FILTER}}` formats a value. For numbers: `3` (digits, the default), `percent`, `error` (of a
///   similarity, in percent), `brief`, `length` (from mm) and `pressure` (from MPa) in a suitable unit. For
///   sections: `is:A` (also `is:A,B`), `above:X`, `below:X`. `address` makes a path the address of a link.
///   For lists and objects: `count`, `some` (a condition), `by` (sides: "20 x 18") and `items`, the entries
///   of an object, each with its `key`. In a loop `row` counts from 1, and `more` is true except for the
///   last item.
///
/// Throws rough::InputError if the kind has no template, or a template or table cannot be read.
std::string render(const PageSource& source, const Rendering& rendering = {});

/// A picture as an SVG document. `figure` is written as after `figures.` in a template. Throws
/// rough::InputError if it cannot be drawn.
std::string figure_file(const std::string& figure, const PageSource& source, const Rendering& rendering = {});

/// The source of a folder (result.json, profile.json or surface.json and its tables), or of a file CURVE.json
/// with its tables CURVE-NAME.csv. Throws rough::InputError.
PageSource page_source(const std::filesystem::path& place);

/// The file of the page: CURVE.html for CURVE.json, else chart.html, stability.html or report.html in the
/// folder, by the kind.
std::filesystem::path page_of(const PageSource& source);

/// Templates, figures and texts that are built in, by the names of their files; .cmake/templates.cmake writes them.
const std::map<std::string, std::string>& builtin_files();

/// A picture to draw: a gnuplot script and its variables.
struct FigureScript {
    std::string script;                ///< begins with a comment line that describes the picture
    std::string style;                 ///< script that runs before it
    std::filesystem::path folder = {}; ///< folder of the tables, in which gnuplot runs; "": the current one
    std::string prefix = {};           ///< beginning of the tables' names; `tables` is "./" before it
    std::string argument;              ///< its variable `arg`
    std::string name;                  ///< beginning of the ids in the picture: letters and digits
    double seconds = 60;               ///< maximum time
};

/// The picture as an <svg> element whose colours are variables of the page, or the reason why it could not be
/// drawn. Runs gnuplot without a shell, a start-up file or a file on the disk. A file name that begins with
/// "./" is never a command or an option of gnuplot.
std::string figure_svg(const FigureScript& figure);

/// The picture as an SVG document with fixed colours. Throws rough::InputError if it cannot be drawn.
std::string figure_document(const FigureScript& figure);

} // namespace app
