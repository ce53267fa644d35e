#include "apps/report/plot.hpp"

#include "apps/report/gnuplot.hpp"
#include "apps/report/plot_svg.hpp"
#include "domain/errors.hpp"
#include "domain/plain_stream.hpp"
#include "ga/base/stopwatch.hpp"

#include <boost/property_tree/exceptions.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace app {

namespace {

void write_axis(std::ostream& out, const char* which, const Axis& axis) {
    out << "set " << which << "label " << gnuplot_text(axis.label) << " noenhanced"
        << (which[0] == 'x' ? " offset 0,0.3" : "") << "\n";
    out << (axis.logarithmic ? "set" : "unset") << " logscale " << which << "\n";
    out << "set format " << which << " " << (axis.logarithmic ? "'10^{%T}'" : "'%g'") << "\n";
    const auto end = [&](double value) -> std::ostream& {
        return std::isnan(value) ? out << "*" : out << value;
    };
    out << "set " << which << "range [";
    end(axis.from) << ":";
    end(axis.to) << "]\n";
    out << "set " << which << "tics autofreq enhanced";
    if (!axis.ticks.empty()) {
        out << "\nset " << which << "tics (";
        for (std::size_t i = 0; i < axis.ticks.size(); ++i)
            out << (i ? ", " : "") << gnuplot_text(axis.ticks[i].second) << " " << axis.ticks[i].first;
        out << ") noenhanced";
    }
    out << "\n";
}

std::string drawn(const Series& series) {
    static constexpr std::array<int, 9> points = {7,  7, 7, 5, 9,
                                                  13, 7, 5, 7}; // circle, square, triangle, diamond
    const auto colour = static_cast<std::size_t>(series.colour);
    rough::PlainStream out;
    const std::string ink = " lc rgb '" + gnuplot_colour(series.colour) + "'";
    const std::string dash = " dt " + std::to_string(static_cast<int>(series.dash) + 1);
    switch (series.style) {
    case Style::line:
        out << "lines lw " << series.width << dash;
        break;
    case Style::steps:
        out << "steps lw " << series.width << dash;
        break;
    case Style::points:
        out << "points pt " << points[colour] << " ps " << 0.3 * series.width;
        break;
    case Style::line_points:
        out << "linespoints lw " << series.width << dash << " pt " << points[colour] << " ps "
            << 0.3 * series.width;
        break;
    case Style::bars:
        out << "boxes fill solid 1 noborder";
        break;
    }
    out << ink;
    return out.str();
}

bool is_drawable(const Series& series) {
    return ((series.x.array().isFinite() && series.y.array().isFinite())).any();
}

/// Of a line through more points than a picture can show, those that can be seen: the lowest and the highest
/// of each run of points that fall on one of `columns` places along the axis.
Series thinned(const Series& line, bool logarithmic) {
    constexpr Eigen::Index most = 4000;
    constexpr double columns = 1000;
    if (line.style != Style::line || line.x.size() <= most)
        return line;
    const auto along = [&](double x) { return logarithmic ? std::log(x) : x; };
    double from = HUGE_VAL, to = -HUGE_VAL;
    for (const double x : line.x)
        if (const double place = along(x); std::isfinite(place))
            from = std::min(from, place), to = std::max(to, place);
    std::vector<Eigen::Index> kept;
    const auto column = [&](Eigen::Index i) {
        return std::floor((along(line.x[i]) - from) / (to - from) * columns);
    };
    for (Eigen::Index i = 0, end = 0; i < line.x.size(); i = end) {
        Eigen::Index low = i, high = i;
        for (end = i + 1; end < line.x.size() && column(end) == column(i); ++end) {
            // A gap is neither lower nor higher than anything: it is kept where it begins a run.
            if (line.y[end] < line.y[low] || std::isnan(line.y[low]))
                low = end;
            if (line.y[end] > line.y[high] || std::isnan(line.y[high]))
                high = end;
        }
        kept.push_back(std::min(low, high));
        if (low != high)
            kept.push_back(std::max(low, high));
    }
    Series result = line;
    result.x = Eigen::VectorXd(line.x(kept));
    result.y = Eigen::VectorXd(line.y(kept));
    return result;
}

/// A series' numbers as a block of the script; a number that is none ends a line's run.
void write_block(std::ostream& out, const Series& series, const std::string& block) {
    out << block << " << EOD\n";
    for (Eigen::Index i = 0; i < series.x.size(); ++i)
        if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
            out << series.x[i] << " " << series.y[i] << " " << series.width << "\n";
        else
            out << "\n";
    out << "EOD\n";
}

/// Points that only a pointer finds, with what stands under it: the series' number, x and y, which tidy_svg
/// puts into words. gnuplot makes them hypertext.
std::string under_pointer(const Series& series, const std::string& block, std::size_t number) {
    constexpr Eigen::Index most = 60;
    const auto every = std::max<Eigen::Index>(1, (series.x.size() + most - 1) / most);
    return ", " + block + " every " + std::to_string(every) + " using 1:2:(sprintf('" +
           std::to_string(number) + " %.4g %.4g',$1,$2)) with labels hypertext point pt 7 ps 1.2 lc rgb '" +
           gnuplot_colour(Colour::unseen) + "' notitle";
}

void write_plot(std::ostream& out, const Plot& plot) {
    std::string drawings;
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
        const Series& series = plot.series[s];
        if (!is_drawable(series))
            continue;
        const std::string block = "$d" + std::to_string(s);
        const Series seen = thinned(series, plot.x.logarithmic);
        write_block(out, seen, block);
        drawings += (drawings.empty() ? "" : ", ") + block + " using 1:2" +
                    (series.style == Style::bars ? ":3" : "") + " with " + drawn(series) +
                    (series.label.empty() ? " notitle" : " title " + gnuplot_text(series.label)) +
                    (series.style == Style::bars ? "" : under_pointer(seen, block, s));
    }
    out << "set terminal svg size 480," << plot.height << " dynamic rounded enhanced font 'Arial,14'\n";
    write_axis(out, "x", plot.x);
    write_axis(out, "y", plot.y);
    out << "set key noenhanced Left reverse samplen 1.6 spacing 1.1 width 2 " << plot.key << "\n";
    out << "unset arrow\n";
    for (const Guide& guide : plot.guides)
        out << "set arrow from " << (guide.across ? "graph 0, first " : "first ") << guide.at
            << (guide.across ? " to graph 1, first " : ", graph 0 to first ") << guide.at
            << (guide.across ? "" : ", graph 1") << " nohead lw 1 dt 2 lc rgb '"
            << gnuplot_colour(Colour::faint) << "'\n";
    out << (drawings.empty() ? "unset logscale\nplot [0:1] [0:1] NaN notitle" : "plot " + drawings) << "\n";
}

/// Dark to light, as people who see colours differently can tell it.
constexpr const char* shades_palette = "set palette defined (0 '#352a87', 0.25 '#0f5cdd', 0.5 '#06a4ca', "
                                       "0.75 '#b1be59', 1 '#f9fb0e') maxcolors 64\n";

/// A picture has no more places than that along an axis.
constexpr Eigen::Index most_shades = 256;

void write_shades(std::ostream& out, const Plot& plot) {
    const Shades& shades = *plot.shades;
    const Eigen::Index columns = shades.values.rows(), rows = shades.values.cols();
    const Eigen::Index every = (std::max(columns, rows) + most_shades - 1) / most_shades;
    out << "$m << EOD\n";
    for (Eigen::Index j = 0; j < rows; j += every) {
        for (Eigen::Index i = 0; i < columns; i += every) {
            // The mean of what is known among the nodes that a place stands for.
            const auto some =
                shades.values.block(i, j, std::min(every, columns - i), std::min(every, rows - j)).array();
            const auto known = some.isFinite();
            known.any() ? out << known.select(some, 0).sum() / static_cast<double>(known.count()) << " "
                        : out << "NaN ";
        }
        out << "\n";
    }
    out << "EOD\nset terminal svg size 480," << plot.height << " dynamic rounded enhanced font 'Arial,14'\n";
    write_axis(out, "x", plot.x);
    write_axis(out, "y", plot.y);
    const auto middle = [every](const char* place, double to, Eigen::Index count) {
        const double node = to / static_cast<double>(std::max<Eigen::Index>(1, count - 1));
        return rough::line_of("(", static_cast<double>(every) * node, "*", place, "+",
                              0.5 * static_cast<double>(every - 1) * node, ")");
    };
    out << "set size ratio -1\nunset grid\n"
        << shades_palette << "set cblabel " << gnuplot_text(shades.label)
        << " noenhanced offset 0.5,0\nplot $m matrix using " << middle("$1", shades.to_x, columns) << ":"
        << middle("$2", shades.to_y, rows) << ":3 with image notitle\nset size noratio\nset grid\n";
}

constexpr const char* document = "<?xml";

/// gnuplot's documents; in their texts '<' is escaped.
std::vector<std::string> documents_of(const std::string& text) {
    std::vector<std::string> documents;
    for (std::size_t at = text.find(document); at != std::string::npos;) {
        const std::size_t next = text.find(document, at + 1);
        documents.push_back(text.substr(at, next - at));
        at = next;
    }
    return documents;
}

/// Pictures of all plots by one process; none of them and a reason where it fails.
Drawing drawn_together(const std::vector<Plot>& plots, const std::string& name, double seconds) {
    rough::PlainStream script;
    script.precision(6);
    script << "set encoding utf8\nset minussign\nset border 3\nset tics nomirror out scale 0.4\nset "
              "grid\nset samples 2\n";
    for (const Plot& plot : plots)
        plot.shades ? write_shades(script, plot) : write_plot(script, plot);
    const Drawn drawn = run_gnuplot(script.str(), seconds);
    const std::vector<std::string> documents = documents_of(drawn.pictures);
    Drawing result{{}, drawn.failure};
    if (result.missing.empty() && documents.size() != plots.size())
        result.missing = "it drew " + std::to_string(documents.size()) + " of " +
                         std::to_string(plots.size()) + " pictures";
    if (!result.missing.empty())
        return result;
    try {
        for (std::size_t i = 0; i < plots.size(); ++i)
            result.pictures.push_back(tidy_svg(documents[i], plots[i], name + std::to_string(i)));
    } catch (const boost::property_tree::ptree_error& error) {
        return {{}, std::string("its picture cannot be read: ") + error.what()};
    }
    return result;
}

} // namespace

Drawing draw(const std::vector<Plot>& plots, const std::string& name, double seconds) {
    if (plots.empty())
        return {};
    const ga::Stopwatch clock;
    Drawing all = drawn_together(plots, name, seconds);
    if (all.missing.empty())
        return all;
    all.pictures.assign(plots.size(), "");
    // One that cannot be drawn must not cost the others.
    for (std::size_t i = 0; plots.size() > 1 && i < plots.size() && clock.seconds() < seconds; ++i) {
        const Drawing one =
            drawn_together({plots[i]}, name + std::to_string(i) + "-", seconds - clock.seconds());
        if (one.missing.empty())
            all.pictures[i] = one.pictures.front();
    }
    all.missing = "gnuplot, which draws the pictures, failed (" + all.missing +
                  "), expected the Debian package gnuplot-nox to be installed";
    return all;
}

Series bundle(const std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>>& curves, Series look) {
    Eigen::Index total = 0;
    for (const auto& curve : curves)
        total += curve.first.size() + 1;
    look.x.resize(total);
    look.y.resize(total);
    Eigen::Index next = 0;
    for (const auto& [x, y] : curves) {
        look.x.segment(next, x.size()) = x;
        look.y.segment(next, y.size()) = y;
        next += x.size();
        look.x[next] = look.y[next] = unset;
        ++next;
    }
    return look;
}

} // namespace app
