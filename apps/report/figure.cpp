#include "apps/external/process.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/render.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"

#include <boost/algorithm/string/replace.hpp>

#include <csignal>
#include <cstdio>
#include <kainjow/mustache.hpp>
#include <memory>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace app {
namespace {

using kainjow::mustache::html_escape;

/// The colours of style.gp as gnuplot writes them, and the variables of the page.
constexpr const char* colours[][2] = {{"rgb(  1,   2,   3)", "var(--ink)"},
                                      {"rgb(128, 129, 130)", "var(--faint)"},
                                      {"rgb(  0, 114, 178)", "var(--blue)"},
                                      {"rgb(230, 159,   0)", "var(--orange)"},
                                      {"rgb(  0, 158, 115)", "var(--green)"},
                                      {"rgb(204, 121, 167)", "var(--purple)"},
                                      {"rgb( 86, 180, 233)", "var(--sky)"},
                                      {"rgb(213,  94,   0)", "var(--red)"},
                                      {"'black'", "'var(--ink)'"},
                                      {"\"black\"", "\"var(--ink)\""},
                                      {"rgb(  0,   0,   0)", "var(--ink)"}};

/// A figure's description: the first line of its script.
std::string description_of(const std::string& script) {
    const std::string line = script.substr(0, script.find('\n'));
    return line.starts_with("# ") ? line.substr(2) : "Picture";
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file in memory that a child may read or write as its standard stream.
File memory_file(const std::string& content = "") {
    File file(fdopen(memfd_create("rugosa", MFD_CLOEXEC), "w+"), std::fclose);
    if (!file || std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
        std::fflush(file.get()) != 0 || lseek(fileno(file.get()), 0, SEEK_SET) != 0)
        rough::refuse("pictures: the system gives no file in memory; set --pictures off");
    return file;
}

std::string content_of(const File& file) {
    return rough::read_whole("/proc/self/fd/" + std::to_string(fileno(file.get())));
}

} // namespace

std::string figure_document(const FigureScript& figure) {
    const auto failure = [](const std::string& why) {
        return rough::InputError("gnuplot did not draw it" + (why.empty() ? "" : ": " + why));
    };
    const File in = memory_file("tables = ARG1\narg = ARG2\nfigure = ARG3\n" + figure.style + figure.script),
               out = memory_file(), err = memory_file();
    pid_t child = 0;
    if (start_process(
            child, {"gnuplot", "-d", "-c", "/dev/stdin", "./" + figure.prefix, printable(figure.argument), figure.name},
            fileno(in.get()), fileno(out.get()), fileno(err.get()), figure.folder) != 0)
        throw failure("it was not found; install the Debian package gnuplot-nox");
    int status = 0;
    if (!process_ended_within(figure.seconds, child, status)) {
        end_group(child, SIGKILL);
        waitpid(child, &status, 0);
        throw failure("it did not end in time");
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw failure(last_line(content_of(err)));
    const std::string pictures = content_of(out);
    if (pictures.find("<svg") == std::string::npos) throw failure("");
    return pictures;
}

std::string figure_svg(const FigureScript& figure) {
    std::string svg;
    try {
        svg = figure_document(figure);
    } catch (const rough::InputError& error) {
        return "No picture: " + html_escape(std::string(error.what())) + ".";
    }
    svg.erase(0, svg.find("<svg"));
    svg.insert(4, " role=\"img\" aria-label=\"" + html_escape(description_of(figure.script)) + "\"");
    for (const auto& [written, variable] : colours) boost::replace_all(svg, written, variable);
    // The markers that gnuplot defines have the same ids in every picture.
    for (const std::string begin : {"id='", "#", "id=\""})
        for (const char* const marker : {"gp", "gnuplot_canvas", "textbox", "greybox", "hypertextBox"})
            boost::replace_all(svg, begin + marker, begin + figure.name + marker);
    return svg;
}

} // namespace app
