#pragma once

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace app {

constexpr double unset = std::numeric_limits<double>::quiet_NaN();

struct Axis {
    std::string label; ///< with its unit, e.g. "Mean pressure p (Pa)"
    bool logarithmic = false;
    double from = unset, to = unset;                        ///< what is shown; unset: as the data have it
    std::vector<std::pair<double, std::string>> ticks = {}; ///< names in place of numbers
};

enum class Style { line, points, line_points, steps, bars };

/// Colours by meaning: `text` is that of the page's own letters and `faint` a quiet one; the rest are the
/// eight colours of Okabe and Ito's set that people who see colours differently can tell apart, as the page
/// shows them. `unseen` is what only a pointer finds.
enum class Colour { text, faint, blue, orange, green, purple, sky, red, unseen };

/// For series without a meaning of their own, in the order in which they are told apart best.
constexpr std::array<Colour, 6> line_colours{Colour::blue,   Colour::orange, Colour::green,
                                             Colour::purple, Colour::sky,    Colour::red};

enum class Dash { solid, dashed, dotted };

/// How the i-th of many lines looks: the colours in turn, then again with the other dash.
constexpr Colour line_colour(std::size_t i) { return line_colours[i % line_colours.size()]; }
constexpr Dash line_dash(std::size_t i) {
    return i / line_colours.size() % 2 == 0 ? Dash::solid : Dash::dashed;
}

struct Series {
    std::string label;    ///< in the key; "" keeps it out
    Eigen::VectorXd x, y; ///< equal lengths; a NaN in y breaks the line
    Colour colour = Colour::blue;
    Style style = Style::line;
    double width = 2; ///< of the line or, times three, of the points, px; of bars in units of x
    Dash dash = Dash::solid;
};

/// A thin line across the picture where an axis has a value.
struct Guide {
    double at;
    bool across = false; ///< horizontal, at a value of y
};

/// Values on the nodes of a rectangle as colours, with their scale beside it.
struct Shades {
    Eigen::MatrixXd values;    ///< a column a row of nodes along x; NaN stays empty
    double to_x = 1, to_y = 1; ///< ends of the axes, which begin at 0
    std::string label;         ///< of the scale, with its unit
};

struct Plot {
    std::string alt;        ///< what there is to see, for who does not see it
    std::string title = {}; ///< a page sets it over the picture
    Axis x, y;
    std::vector<Series> series = {};
    std::vector<Guide> guides = {};
    std::string key = "tmargin left horizontal"; ///< where the labels stand, in gnuplot's words; or "off"
    double height = 300;                         ///< of 480 units wide
    std::optional<Shades> shades = {};           ///< under the series
};

/// Pictures, each empty where it could not be drawn, and why.
struct Drawing {
    std::vector<std::string> pictures;
    std::string missing; ///< "" where none is
};

/// Draws plots by gnuplot, all in one process of at most so many seconds: an <svg> element each, to stand in
/// a page next to others (nothing in it has an id that another one has; its colours are the classes of
/// `plot_style`). `name` begins the ids. A line of more points than can be seen is drawn through those that
/// can.
Drawing draw(const std::vector<Plot>& plots, const std::string& name = "plot", double seconds = 60);

/// One of them as a file of its own.
std::string svg_file(std::string picture);

/// CSS for the pictures, light and dark.
const std::string& plot_style();

/// A series that draws several curves in one style, each from its first point on.
Series bundle(const std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>>& curves, Series look);

} // namespace app
