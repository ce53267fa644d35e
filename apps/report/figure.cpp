#include "apps/external/process.hpp"
#include "apps/report/render.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <kainjow/mustache.hpp>
#include <sstream>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace app {

namespace {

using kainjow::mustache::html_escape;

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

/// A figure's description: the first line of its script.
std::string told_by(const std::string& script) {
    const std::string line = script.substr(0, script.find('\n'));
    return line.starts_with("# ") ? line.substr(2) : "Picture";
}

/// The outcome of a script.
struct Drawn {
    std::string pictures; ///< its standard output
    std::string failure;  ///< why it made none, in a few words
};

/// A file in memory that a child may read or write as its standard stream.
class MemoryFile {
  public:
    MemoryFile() : file_(memfd_create("rugosa", MFD_CLOEXEC)) {
        if (file_ < 0)
            throw rough::InputError("pictures: the system gives no file in memory, expected one to draw in");
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;

    int get() const { return file_; }
    std::string content() const { return rough::read_whole("/proc/self/fd/" + std::to_string(file_)); }
    void fill(std::string_view content) const {
        while (!content.empty()) {
            const ssize_t written = write(file_, content.data(), content.size());
            if (written < 0 && errno != EINTR)
                throw rough::InputError("pictures: no memory to draw in");
            content.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
        }
        lseek(file_, 0, SEEK_SET);
    }

  private:
    int file_;
};

/// The last line of a complaint that is more than a mark under the place.
std::string told(const std::string& complaint) {
    std::istringstream lines(complaint);
    std::string line, last;
    while (std::getline(lines, line))
        if (line.find_first_not_of(" ^\t") != std::string::npos)
            last = line;
    return last;
}

/// Runs gnuplot on a script without a shell, a start-up file or a file on the disk. After `seconds` gnuplot
/// and its children are killed.
Drawn run_gnuplot(const std::string& script, double seconds) {
    const MemoryFile in, out, err;
    in.fill(script);
    pid_t child = 0;
    if (start_process(child, {"gnuplot", "-d"}, in.get(), out.get(), err.get()) != 0) // no start-up file
        return {"", "it was not found; install the Debian package gnuplot-nox"};
    int status = 0;
    if (!process_ended_within(seconds, child, status)) {
        kill(-child, SIGKILL);
        waitpid(child, &status, 0);
        return {"", "it was not done in time"};
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return {"", told(err.content())};
    return {out.content(), ""};
}

/// A text as a string of gnuplot's that is this text and nothing else. A character that could end it, be
/// expanded or be run is written as its number.
std::string gnuplot_text(const std::string& text) {
    std::string result = "\"";
    for (const char c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            result += ' ';
        else if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '`')
            result += "\\140\".\""; // by its number, which a digit behind it would change
        else
            result += c;
    return result + "\"";
}

} // namespace

std::string figure_document(const FigureScript& figure) {
    const Drawn drawn =
        run_gnuplot("tables = " + gnuplot_text(figure.tables) + "\narg = " + gnuplot_text(figure.argument) +
                        "\nfigure = " + gnuplot_text(figure.name) + "\n" + figure.style + figure.script,
                    figure.seconds);
    if (drawn.pictures.find("<svg") == std::string::npos)
        throw rough::InputError("gnuplot did not draw it" +
                                (drawn.failure.empty() ? "" : ": " + drawn.failure));
    return drawn.pictures;
}

std::string figure_svg(const FigureScript& figure) {
    std::string svg;
    try {
        svg = figure_document(figure);
    } catch (const rough::InputError& error) {
        return "<p>No picture: " + html_escape(std::string(error.what())) + ".</p>";
    }
    svg.erase(0, svg.find("<svg"));
    svg.insert(4, " role=\"img\" aria-label=\"" + html_escape(told_by(figure.script)) + "\"");
    for (const auto& [written, variable] : colours)
        replace_all(svg, written, variable);
    // The markers that gnuplot defines have the same ids in every picture.
    for (const char* const begin : {"id='", "#", "id=\""})
        for (const char* const marker : {"gp", "gnuplot_canvas", "textbox", "greybox", "hypertextBox"})
            replace_all(svg, std::string(begin) + marker, begin + figure.name + marker);
    return svg;
}

} // namespace app
