#include "apps/report/plot.hpp"
#include "apps/report/units.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/report/svg.hpp"

#include <boost/property_tree/xml_parser.hpp>
#include <catch2/catch.hpp>

#include <cstdlib>
#include <set>

using namespace app;
using namespace app::testing;

namespace {

Plot plot_of(const Eigen::VectorXd& y, Style style = Style::line_points) {
    Plot plot;
    plot.alt = "K < 1 & \"rising\"";
    plot.x = {"p_max (Pa)"};
    plot.y = {"K'"};
    plot.series = {{"a_b {c}", Eigen::VectorXd::LinSpaced(y.size(), 1, static_cast<double>(y.size())), y,
                    Colour::red, style}};
    return plot;
}

void require_well_formed(const std::string& xml) {
    std::istringstream in(xml);
    boost::property_tree::ptree tree;
    REQUIRE_NOTHROW(boost::property_tree::read_xml(in, tree));
}

} // namespace

TEST_CASE("pictures on one page have no id in common, and every marker that is used is there") {
    const auto pictures = svg({plot_of(Eigen::Vector3d(1, 2, 3)), plot_of(Eigen::Vector3d(3, 2, 1))});
    REQUIRE(pictures.size() == 2);
    std::set<std::string> ids;
    for (const std::string& picture : pictures) {
        require_well_formed(picture);
        for (const std::string& id : found(picture, " id=\"([^\"]*)\""))
            CHECK(ids.insert(id).second);
        const auto used = found(picture, "href=\"#([^\"]*)\"");
        CHECK(used.size() >= 3);
        for (const std::string& id : used)
            CHECK(ids.contains(id));
    }
}

TEST_CASE("labels are text as written, and the picture tells what it shows") {
    const std::string picture = svg({plot_of(Eigen::Vector3d(1, 2, 3))}).front();
    CHECK(picture.find(">p_max (Pa)</text>") != std::string::npos);
    CHECK(picture.find(">a_b {c}</text>") != std::string::npos);
    CHECK(picture.find(">K'</text>") != std::string::npos);
    CHECK(picture.find("aria-label=\"K &lt; 1 &amp; &quot;rising&quot;\"") != std::string::npos);
    CHECK(picture.find("font-family") == std::string::npos);
}

TEST_CASE("a missing number breaks a line, and data without numbers leave an empty frame") {
    const auto strokes = [](const Eigen::VectorXd& y) {
        const std::string picture = svg({plot_of(y, Style::line)}).front();
        const auto paths = found(picture, "class=\"red\"[^>]* d=\"([^\"]*)\"");
        REQUIRE(paths.size() == 1);
        return std::count(paths[0].begin(), paths[0].end(), 'M');
    };
    const double gap = std::nan("");
    CHECK(strokes(Eigen::Vector<double, 5>(1, 2, gap, 4, 5)) ==
          strokes(Eigen::Vector<double, 5>(1, 2, 3, 4, 5)) + 1);
    const std::string empty = svg({plot_of(Eigen::Vector3d(gap, gap, gap))}).front();
    require_well_formed(empty);
    CHECK(empty.find("p_max (Pa)") != std::string::npos);
}

TEST_CASE("logarithmic axes, bars, steps and named ticks draw without complaint") {
    Plot plot = plot_of(Eigen::Vector3d(1e-6, 1e-3, 1), Style::steps);
    plot.y.logarithmic = true;
    plot.guides = {{2}, {1e-3, true}};
    Plot bars = plot_of(Eigen::Vector3d(1, 2, 3), Style::bars);
    bars.x.ticks = {{1, "it's one"}, {2, "two"}};
    const auto pictures = svg({plot, bars, plot_of(Eigen::Vector3d(1, 2, 3), Style::points)});
    for (const std::string& picture : pictures)
        require_well_formed(picture);
    CHECK(pictures[0].find("dy=") != std::string::npos); // a power of ten
    CHECK(found(pictures[1], "<polygon class=\"(red)\"").size() >= 3);
    CHECK(pictures[1].find("it's one") != std::string::npos);
}

TEST_CASE("a picture as a file brings its own colours") {
    const std::string file = svg_file(svg({plot_of(Eigen::Vector3d(1, 2, 3))}).front());
    require_well_formed(file);
    CHECK(file.find("<style>") != std::string::npos);
    CHECK(file.find(".plot .red{color:") != std::string::npos);
}

TEST_CASE("values on a rectangle are an image with a scale of its own colours") {
    Plot plot;
    plot.alt = "Heights";
    plot.x = {"x (mm)", false, 0, 2};
    plot.y = {"y (mm)", false, 0, 1};
    plot.shades = {Eigen::MatrixXd::Random(300, 20), 2, 1, "Height (mm)"};
    plot.shades->values(3, 3) = unset;
    const std::string picture = svg({plot, Plot{}}).front();
    CHECK(picture.find("<image preserveAspectRatio=\"none\"") != std::string::npos);
    CHECK(picture.find("href=\"data:image/png;base64,") != std::string::npos);
    CHECK(picture.find("style=\"fill:rgb(") != std::string::npos);
    CHECK(picture.find("Height (mm)") != std::string::npos);
}

TEST_CASE("without gnuplot a picture is refused in one line that says what to install") {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const std::string message = draw({plot_of(Eigen::Vector3d(1, 2, 3))}).missing;
    setenv("PATH", path.c_str(), 1);
    CHECK(message.find("gnuplot-nox") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("quantities are shown in the unit that suits them") {
    CHECK(pressure_unit(1.6e-4).name == "Pa");
    CHECK(pressure_unit(0.04).name == "kPa");
    CHECK(pressure_unit(2).name == "MPa");
    CHECK(pressure_unit(5e4).name == "GPa");
    CHECK(length_unit(1.2e-4).name == "nm");
    CHECK(length_unit(0.02).name == "µm");
    CHECK(length_unit(0.85 * 2e3).name == "m");
    CHECK(0.02 * length_unit(0.02).factor == Approx(20));
}

TEST_CASE("numbers for reading keep their significant digits") {
    CHECK(readable(0.95431) == "0.954");
    CHECK(readable(66.6667, 4) == "66.67");
    CHECK(readable(-12.34, 2) == "−12");
    CHECK(readable(0) == "0");
    CHECK(readable(1.26e-9, 2) == "1.3 × 10⁻⁹");
    CHECK(brief(30.04, 3) == "30");
    CHECK(brief(0.1) == "0.1");
    CHECK(brief(1200) == "1200");
    CHECK(brief(1.02e-9) == "1 × 10⁻⁹");
    CHECK(percent(0.0321, 2) == "3.2 %");
    CHECK(readable(std::nan("")) == "–");
    CHECK(readable(9.996) == "10.0");
    CHECK(readable(999999.9) == "1.00 × 10⁶");
}

TEST_CASE("every point of a short line, and some of a long one, tell their values under the pointer") {
    app::Plot plot;
    plot.series.push_back({"it's <A & B>", Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0.5, -7, 1e-9)});
    plot.series.push_back({"", Eigen::VectorXd::LinSpaced(900, 1, 3), Eigen::VectorXd::LinSpaced(900, 0, 1)});
    const std::string picture = svg({plot}).front();
    CHECK_THAT(picture, Catch::Contains("<title>it's &lt;A &amp; B&gt;: 1, 0.5</title>") &&
                            Catch::Contains(": 3, 1e-09</title>") && Catch::Contains("<title>1, 0</title>") &&
                            !Catch::Contains("onmouse"));
    std::size_t titles = 0;
    for (std::size_t at = 0; (at = picture.find("<title>", at)) != std::string::npos; ++at)
        ++titles;
    CHECK(titles <= 3 + 60 + 1); // and the label in the key
}
