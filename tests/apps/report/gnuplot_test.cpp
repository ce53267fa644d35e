#include "apps/report/gnuplot.hpp"
#include "apps/report/page.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/apps/report/svg.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>

using namespace app;
using app::testing::svg;
using tests::Folder;

namespace {

Plot plot_named(const std::string& name) {
    Plot plot;
    plot.alt = name;
    plot.x = {name};
    plot.x.ticks = {{1, name}};
    plot.y = {"y"};
    plot.series = {{name, Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2)}};
    return plot;
}

/// An environment variable that is as it was again afterwards.
class Environment {
  public:
    Environment(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name))
            before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Environment() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Environment(const Environment&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

/// A folder with a program of gnuplot's name.
std::string with_gnuplot(const Folder& folder, const std::string& script) {
    std::filesystem::permissions(folder.write("gnuplot", "#!/bin/sh\n" + script),
                                 std::filesystem::perms::owner_all);
    return folder.path().string() + ":" + std::getenv("PATH");
}

} // namespace

TEST_CASE("a label is the text that it is, whatever gnuplot would make of it") {
    const Folder folder;
    const std::string harm = (folder / "harm").string();
    for (const std::string& label : {std::string("'quoted"), "`touch " + harm + "`1",
                                     std::string("say \"hi\"\\n"), "\"; system 'touch " + harm + "'; \"",
                                     std::string("alert(1) `7"), std::string("$(date) @m {/Bold x} %s")}) {
        INFO(label);
        const std::string picture = svg({plot_named(label)}).front();
        CHECK(picture.find(">" + escaped(label) + "</text>") != std::string::npos);
    }
    CHECK_FALSE(std::filesystem::exists(harm));
}

TEST_CASE("pictures need no shell, no temporary folder and none of the user's gnuplot settings") {
    const Folder folder;
    const std::string harm = (folder / "harm").string();
    folder.write(".gnuplot", "system 'touch " + harm + "'\n");
    const Environment home("HOME", folder.path().string()), temporary("TMPDIR", "|touch '" + harm + "'");
    CHECK_NOTHROW(svg({plot_named("a")}));
    CHECK_FALSE(std::filesystem::exists(harm));
}

TEST_CASE(
    "a gnuplot that hangs is ended with all that it started, and the report is there without pictures") {
    const Folder folder;
    const Environment path(
        "PATH", with_gnuplot(folder, "sleep 1000 & echo $! >" + (folder / "child").string() + "; wait"));
    Page page("t", "l");
    page.figure({"f", "Title", "Caption", {plot_named("a"), plot_named("b")}});
    const std::string html = page.html(0.3);
    CHECK(html.find("No picture: ") != std::string::npos);
    CHECK(html.find("Caption") != std::string::npos);
    const std::string child = rough::read_whole(folder / "child");
    const std::string process = "/proc/" + child.substr(0, child.find('\n')) + "/exe";
    for (int i = 0; i < 1000 && std::filesystem::exists(process); ++i) // killed, it may not have gone yet
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK_FALSE(std::filesystem::exists(process));
}

TEST_CASE("a picture that gnuplot refuses costs no other one") {
    Plot bad = plot_named("a");
    bad.key = "in no words of gnuplot";
    const Drawing drawing = draw({plot_named("b"), bad, plot_named("c")});
    REQUIRE(drawing.pictures.size() == 3);
    CHECK_FALSE(drawing.pictures[0].empty());
    CHECK(drawing.pictures[1].empty());
    CHECK_FALSE(drawing.pictures[2].empty());
    CHECK_FALSE(drawing.missing.empty());
}

TEST_CASE("a line of a million points is drawn through those that can be seen") {
    Plot plot = plot_named("wave");
    plot.series[0].x = Eigen::VectorXd::LinSpaced(1'000'000, 1, 1e6);
    plot.series[0].y = plot.series[0].x.array().sin();
    plot.series[0].y[345'678] = 50;
    plot.y.to = 50;
    const std::string full = svg({plot}).front();
    CHECK(full.size() < 100'000);
    plot.series[0].y[345'678] = 49;
    CHECK(svg({plot}).front() != full); // the one high point is seen
}
