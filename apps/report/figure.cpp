#include "apps/report/figure.hpp"

#include "apps/report/gnuplot.hpp"
#include "apps/report/html.hpp"
#include "domain/errors.hpp"

#include <array>
#include <string_view>

namespace app {

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// gnuplot's colours of style.gp, as it writes them, and the page's variables.
constexpr std::array<std::array<const char*, 2>, 11> colours{{{"rgb(  1,   2,   3)", "var(--ink)"},
                                                              {"rgb(128, 129, 130)", "var(--faint)"},
                                                              {"rgb(  0, 114, 178)", "var(--blue)"},
                                                              {"rgb(230, 159,   0)", "var(--orange)"},
                                                              {"rgb(  0, 158, 115)", "var(--green)"},
                                                              {"rgb(204, 121, 167)", "var(--purple)"},
                                                              {"rgb( 86, 180, 233)", "var(--sky)"},
                                                              {"rgb(213,  94,   0)", "var(--red)"},
                                                              {"'black'", "'var(--ink)'"},
                                                              {"\"black\"", "\"var(--ink)\""},
                                                              {"rgb(  0,   0,   0)", "var(--ink)"}}};

/// What a script's first line says is to be seen.
std::string told_by(const std::string& script) {
    const std::string line = script.substr(0, script.find('\n'));
    return line.starts_with("# ") ? line.substr(2) : "Picture";
}

} // namespace

std::string figure_document(const FigureScript& figure) {
    const Drawn drawn =
        run_gnuplot("tables = " + gnuplot_text(figure.tables) + "\narg = " + gnuplot_text(figure.argument) +
                        "\nfigure = " + gnuplot_text(figure.name) + "\n" + figure.style + figure.script,
                    figure.seconds);
    if (drawn.pictures.find("<svg") == std::string::npos)
        throw rough::InputError("gnuplot did not draw it" +
                                (drawn.failure.empty() ? "" : " (" + drawn.failure + ")") +
                                "; install the Debian package gnuplot-nox");
    return drawn.pictures;
}

std::string figure_svg(const FigureScript& figure) {
    std::string svg;
    try {
        svg = figure_document(figure);
    } catch (const rough::InputError& error) {
        return "<p>No picture: " + escaped(error.what()) + ".</p>";
    }
    svg.erase(0, svg.find("<svg"));
    svg.insert(4, " role=\"img\" aria-label=\"" + escaped(told_by(figure.script)) + "\"");
    for (const auto& [written, variable] : colours)
        replace_all(svg, written, variable);
    // The markers that gnuplot defines have the same ids in every picture.
    for (const char* const begin : {"id='", "#", "id=\""})
        for (const char* const marker : {"gp", "gnuplot_canvas", "textbox", "greybox", "hypertextBox"})
            replace_all(svg, std::string(begin) + marker, begin + figure.name + marker);
    return svg;
}

} // namespace app
