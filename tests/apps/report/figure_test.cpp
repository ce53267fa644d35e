#include "apps/report/render.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/environment.hpp"
#include "tests/folder.hpp"

#include <chrono>
#include <fstream>
#include <thread>

using namespace app;
using tests::Environment;
using tests::Folder;

namespace {

FigureScript labelled(const std::string& label) {
    return {.script = "# A < B\nset xlabel arg noenhanced\nplot [1:2] x with linespoints lc rgb blue title 'a'\n",
            .style = builtin_files().at("style.gp"),
            .argument = label,
            .name = "figure1"};
}

} // namespace

TEST_CASE("a picture has the colours of the page, a description and unique ids") {
    const std::string svg = figure_svg(labelled("x"));
    CHECK_THAT(svg, Catch::StartsWith("<svg role=\"img\" aria-label=\"A &lt; B\"") && Catch::Contains("var(--blue)") &&
                        Catch::Contains("id='figure1gp") && !Catch::Contains("rgb(  0, 114, 178)") &&
                        !Catch::Contains("id='gp"));
    CHECK_THAT(figure_document(labelled("x")), Catch::StartsWith("<?xml") && !Catch::Contains("var("));
}

TEST_CASE("a label shows as its text, even with special characters of gnuplot") {
    const Folder folder;
    const std::string harm = (folder / "harm").string();
    for (const auto& [label, shown] : {std::pair(std::string("'quoted"), std::string("'quoted")),
                                       {"`touch " + harm + "`1", "`touch " + harm + "`1"},
                                       {"\"; system 'touch " + harm + "'; \"", "\"; system 'touch " + harm + "'; \""},
                                       {"$(date) @m {/Bold x} %s", "$(date) @m {/Bold x} %s"}}) {
        INFO(label);
        CHECK_THAT(figure_svg(labelled(label)), Catch::Contains(">" + shown + "<"));
    }
    CHECK_FALSE(std::filesystem::exists(harm));
}

TEST_CASE("no name of a folder or a table is a command, an option or a format for a figure") {
    const Folder folder;
    const std::string harm = "touch \"$HARM\"; echo x ";
    const Environment place("HARM", (folder / "harm").string());
    for (const std::string& name :
         {"<" + harm, "|" + harm, "`" + harm + "`", "$(" + harm + ")", "'; system('" + harm + "'); '",
          std::string("-e system('touch harm')"), std::string("~\n%s%n{Bold @m} \xff\xfe\"")}) {
        INFO(name);
        // A name of a folder cannot contain "/", so a command cannot name a path.
        const auto inside = folder / name;
        std::filesystem::create_directory(inside);
        const auto draw = [&](const std::string& figure, const std::string& argument) {
            return figure_svg({.script = builtin_files().at(figure),
                               .style = builtin_files().at("style.gp"),
                               .folder = inside,
                               .prefix = name + ".",
                               .argument = argument,
                               .name = "figure1"});
        };
        if (name.starts_with("<")) // gnuplot starts such a name of a table
            for (const auto& [file, content] : builtin_files())
                if (file.ends_with(".gp") && file != "style.gp") draw(file, name + " " + name);
        CHECK(std::filesystem::is_empty(inside));
        std::ofstream(inside / (name + ".csv"))
            << "pressure_MPa,contact_fraction,tangent_stiffness_MPa_per_mm\n1,0.1,3\n2,0.2,4\n";
        CHECK_THAT(draw("contact-curve.gp", "stiffness .csv"), Catch::StartsWith("<svg"));
    }
    CHECK_FALSE(std::filesystem::exists(folder / "harm"));
}

TEST_CASE("a picture needs no shell, temporary folder or gnuplot settings of the user") {
    const Folder folder;
    const std::string harm = (folder / "harm").string();
    folder.write(".gnuplot", "system 'touch " + harm + "'\n");
    const Environment home("HOME", folder.path().string()), temporary("TMPDIR", "|touch '" + harm + "'");
    CHECK_NOTHROW(figure_document(labelled("a")));
    CHECK_FALSE(std::filesystem::exists(harm));
}

TEST_CASE("a gnuplot that hangs is killed with its children") {
    const Folder folder;
    std::filesystem::permissions(
        folder.write("gnuplot", "#!/bin/sh\nsleep 1000 & echo $! >" + (folder / "child").string() + "; wait"),
        std::filesystem::perms::owner_all);
    const Environment path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    FigureScript figure = labelled("a");
    figure.seconds = 0.3;
    CHECK_THAT(figure_svg(figure), Catch::Contains("No picture: "));
    const std::string child = rough::read_whole(folder / "child");
    const std::string process = "/proc/" + child.substr(0, child.find('\n')) + "/exe";
    for (int i = 0; i < 1000 && std::filesystem::exists(process); ++i) // killed, it may need some time to end
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK_FALSE(std::filesystem::exists(process));
}

TEST_CASE("without gnuplot a picture is a line that names the package to install") {
    const Environment path("PATH", "/nowhere");
    CHECK_THAT(figure_svg(labelled("a")), Catch::Contains("gnuplot-nox") && !Catch::Contains("\n"));
    CHECK_THROWS_AS(figure_document(labelled("a")), rough::InputError);
}
