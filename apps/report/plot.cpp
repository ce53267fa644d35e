#include "apps/report/plot.hpp"

#include "apps/report/plot_svg.hpp"
#include "domain/errors.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace app {

namespace {

namespace fs = std::filesystem;

/// A folder of its own that goes when it is left.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "rugosa-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw rough::InputError(fs::temp_directory_path().string() +
                                    ": cannot make a folder for pictures, "
                                    "expected one that can be written");
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    fs::path operator/(const std::string& name) const { return path_ / name; }

  private:
    fs::path path_;
};

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (char c : text)
        result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
    return result + "'";
}

void write_axis(std::ostream& out, const char* which, const Axis& axis) {
    out << "set " << which << "label " << quoted(axis.label) << " noenhanced"
        << (which[0] == 'x' ? " offset 0,0.3" : "") << "\n";
    out << (axis.logarithmic ? "set" : "unset") << " logscale " << which << "\n";
    out << "set format " << which << " " << (axis.logarithmic ? "'10^{%T}'" : "'%g'") << "\n";
    const auto end = [&](double value) -> std::ostream& {
        return std::isnan(value) ? out << "*" : out << value;
    };
    out << "set " << which << "range [";
    end(axis.from) << ":";
    end(axis.to) << "]\n";
    out << "set " << which << "tics autofreq";
    if (!axis.ticks.empty()) {
        out << "\nset " << which << "tics (";
        for (std::size_t i = 0; i < axis.ticks.size(); ++i)
            out << (i ? ", " : "") << quoted(axis.ticks[i].second) << " " << axis.ticks[i].first;
        out << ")";
    }
    out << "\n";
}

std::string drawn(const Series& series) {
    static constexpr std::array<int, 8> points = {7, 7,  7, 5,
                                                  9, 13, 7, 5}; // circle, square, triangle, diamond
    const auto colour = static_cast<std::size_t>(series.colour);
    std::ostringstream out;
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

void write_plot(std::ostream& out, const Plot& plot, const fs::path& picture) {
    std::string drawings;
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
        const Series& series = plot.series[s];
        if (!is_drawable(series))
            continue;
        const std::string block = "$d" + std::to_string(s);
        write_block(out, series, block);
        drawings += (drawings.empty() ? "" : ", ") + block + " using 1:2" +
                    (series.style == Style::bars ? ":3" : "") + " with " + drawn(series) +
                    (series.label.empty() ? " notitle" : " title " + quoted(series.label));
    }
    out << "set terminal svg size 480," << plot.height << " dynamic rounded enhanced font 'Arial,14'\n"
        << "set output " << quoted(picture.string()) << "\n";
    write_axis(out, "x", plot.x);
    write_axis(out, "y", plot.y);
    out << "set key noenhanced Left reverse samplen 1.6 spacing 1.1 width 2 " << plot.key << "\n";
    out << "unset arrow\n";
    for (const Guide& guide : plot.guides)
        out << "set arrow from " << (guide.across ? "graph 0, first " : "first ") << guide.at
            << (guide.across ? " to graph 1, first " : ", graph 0 to first ") << guide.at
            << (guide.across ? "" : ", graph 1") << " nohead lw 1 dt 2 lc rgb '"
            << gnuplot_colour(Colour::faint) << "'\n";
    out << (drawings.empty() ? "unset logscale\nplot [0:1] [0:1] NaN notitle" : "plot " + drawings)
        << "\nunset output\n";
}

} // namespace

std::vector<std::string> svg(const std::vector<Plot>& plots, const std::string& name) {
    const TemporaryFolder folder;
    const auto picture = [&](std::size_t i) { return folder / (std::to_string(i) + ".svg"); };
    {
        std::ofstream script(folder / "script");
        script.precision(6);
        script << "set encoding utf8\nset minussign\nset border 3\nset tics nomirror out scale 0.4\nset "
                  "grid\nset samples 2\n";
        for (std::size_t i = 0; i < plots.size(); ++i)
            write_plot(script, plots[i], picture(i));
    }
    const std::string command =
        "gnuplot '" + (folder / "script").string() + "' >/dev/null 2>'" + (folder / "errors").string() + "'";
    const int status = std::system(command.c_str());
    if (status != 0) {
        std::istringstream errors(content(folder / "errors"));
        std::string line, told;
        while (std::getline(errors, line))
            if (line.find_first_not_of(" ^\t") != std::string::npos)
                told = line;
        throw rough::InputError("gnuplot, which draws the pictures, failed (" + told +
                                "), expected the Debian package gnuplot-nox to be installed");
    }
    std::vector<std::string> result;
    for (std::size_t i = 0; i < plots.size(); ++i)
        result.push_back(tidy_svg(content(picture(i)), plots[i], name + std::to_string(i)));
    return result;
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
