#include "apps/report/csv.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/making_errors.hpp"
#include "tests/apps/results.hpp"
#include "tests/domain/problem/about_points.hpp"

#include <numbers>

using namespace app::testing;
using nlohmann::json;
using rough::Index;

namespace {

constexpr double length = 0.5, modulus = 2 / (1 - 0.3 * 0.3); // mm, MPa
constexpr Index nodes = 97;
constexpr int steps = 12;
const std::vector<double> pressures{0.001, 0.002, 0.004, 0.006, 0.008}, stiffnesses{1.5, 1.8, 2.2, 2.5, 2.8};

/// All numbers in a sentence, in order.
std::vector<double> numbers_in(const std::string& text) {
    return rough::column(found(text, "(-?[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?)"),
                         [](const std::string& number) { return std::stod(number); });
}

/// A unit's length in mm, or pressure in MPa.
double in_program_units(double value, const std::string& unit) {
    const std::map<std::string, double> units{{"nm", 1e-6}, {"µm", 1e-3},  {"mm", 1},
                                              {"Pa", 1e-6}, {"kPa", 1e-3}, {"MPa", 1}};
    return value * units.at(unit);
}

/// The design of the test, from its result.json alone.
struct Recomputed {
    json genome;

    /// Heights by the definition of the waves; `order`-th derivative in x.
    Eigen::VectorXd heights(Index n, int order = 0) const {
        const double pi = std::numbers::pi, spacing = length / static_cast<double>(n - 1);
        Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
        for (const json& series : genome["series"]) {
            const double A = series["A"], H = series["H"], gamma = series["gamma"], lambda = series["lambda"];
            for (const json& each : series["chromosomes"]) {
                const int number = each["n"];
                const double k = 2 * pi / lambda * std::pow(gamma, number - 1),
                             G = A * std::sqrt(std::log10(gamma) / static_cast<double>(each["phases"].size())) *
                                 std::pow(2 * pi / lambda, -H) * std::pow(gamma, -(number - 1) * H);
                for (const double phase : each["phases"])
                    for (Index i = 0; i < n; ++i) // derivatives of cos(phase) - cos(k x + phase)
                        z[i] += G * std::pow(k, order) *
                                ((order == 0 ? std::cos(phase) : 0) -
                                 std::cos(k * spacing * static_cast<double>(i) + phase + order * pi / 2));
            }
        }
        return z * genome.value("scale", 1.);
    }
    double shortest_wave() const {
        double shortest = HUGE_VAL;
        for (const json& series : genome["series"])
            for (const json& each : series["chromosomes"])
                shortest = std::min(shortest, series["lambda"].get<double>() *
                                                  std::pow(series["gamma"].get<double>(), 1 - each["n"].get<int>()));
        return shortest;
    }
    rough::Response response(const Eigen::VectorXd& z, double datum = length, std::vector<double> shares = {}) const {
        rough::Body body;
        body.effective_modulus = modulus;
        body.datum = datum;
        return respond(rough::Profile{z, length / static_cast<double>(z.size() - 1)}, body,
                       {.steps = steps, .to_pressure = pressures.back(), .shares = std::move(shares)});
    }
    /// The response in the load steps of a verification.
    rough::Response about_points(const Eigen::VectorXd& z) const {
        return response(z, length,
                        rough::testing::shares_about(response(z), Eigen::VectorXd::Map(pressures.data(), 5), 64));
    }
    /// K of the secants at each pressure of the target, over the target, minus 1.
    Eigen::VectorXd misfits(const rough::Response& of, double compliance = 0) const {
        std::vector<double> x, y;
        for (Index j = 0; j < of.steps(); ++j) {
            const double p = j > 0 ? of.pressure[j - 1] : 0, d = j > 0 ? of.displacement[j - 1] : 0;
            x.push_back((of.pressure[j] + p) / 2);
            y.push_back((of.pressure[j] - p) / (of.displacement[j] - d));
        }
        Eigen::VectorXd off(static_cast<Index>(pressures.size()));
        for (std::size_t k = 0; k < pressures.size(); ++k) {
            std::size_t i = 0;
            while (i + 2 < x.size() && x[i + 1] < pressures[k]) ++i;
            const double found = y[i] + (y[i + 1] - y[i]) * (pressures[k] - x[i]) / (x[i + 1] - x[i]);
            off[static_cast<Index>(k)] = found / (1 / (1 / stiffnesses[k] + compliance)) - 1;
        }
        return off;
    }
    /// The lower and the higher tangent over the secant - 1 in the load step of each pressure of the target.
    Eigen::MatrixX2d ranges_in_step(const rough::Response& of) const {
        Eigen::MatrixX2d ranges(static_cast<Index>(pressures.size()), 2);
        for (std::size_t k = 0; k < pressures.size(); ++k) {
            Index b = 1;
            while (b + 1 < of.steps() && of.pressure[b] < pressures[k]) ++b;
            const double secant = (of.pressure[b] - of.pressure[b - 1]) / (of.displacement[b] - of.displacement[b - 1]);
            const auto [low, high] =
                std::minmax({1., of.tangent_stiffness[b - 1] / secant, of.tangent_stiffness[b] / secant});
            ranges.row(static_cast<Index>(k)) << low - 1, high - 1;
        }
        return ranges;
    }
};

} // namespace

TEST_CASE("every number on a design's first screen follows from its genome and target") {
    const Folder folder;
    std::string target = "pressure_MPa,stiffness_MPa_per_mm\n";
    for (std::size_t k = 0; k < pressures.size(); ++k)
        target += std::to_string(pressures[k]) + "," + std::to_string(stiffnesses[k]) + "\n";
    folder.write("K.csv", target);
    const json result = result_of(
        folder, "design --target K.csv --nodes 97 --length 0.5 --modulus 2 --poisson 0.3 --steps 12 --draws 1000 "
                "--pipeline 'shape 6 | score | best 2 | refine lm 8 | best 1'");
    const json &variant = result["variants"]["pipeline"], &summary = result["summary"];
    const Recomputed design{variant["genome"]};
    const Eigen::VectorXd z = design.heights(nodes), half = design.heights(2 * nodes - 1),
                          fine = design.heights(4 * nodes - 3);
    const rough::Response own = design.response(z), on_fine = design.response(fine);
    const Eigen::VectorXd own_misfits = design.misfits(own), fine_misfits = design.misfits(on_fine),
                          coarse = design.misfits(design.about_points(z)),
                          between = design.misfits(design.about_points(half));
    const rough::Response verified = design.about_points(fine);
    const Eigen::VectorXd finest = design.misfits(verified);
    const auto similarity_of = [](const Eigen::VectorXd& misfits) { return 1 - misfits.cwiseAbs().maxCoeff(); };
    const std::vector<double> checks{similarity_of(own_misfits), similarity_of(fine_misfits), similarity_of(coarse),
                                     similarity_of(finest)};
    // The misfits that decide are those of the finest curve, moved by its estimated error.
    const Eigen::VectorXd by_steps = (fine_misfits - finest).cwiseAbs(), by_grid = (between - finest).cwiseAbs(),
                          before = (coarse - between).cwiseAbs();
    const Eigen::MatrixX2d ranges = design.ranges_in_step(verified);
    Eigen::VectorXd decides(finest.size());
    double largest = 0, at = 0;
    for (Index k = 0; k < finest.size(); ++k) {
        const Index from = std::max<Index>(0, k - 1), count = std::min(finest.size(), k + 2) - from;
        const auto about = [&](const Eigen::VectorXd& changes) { return changes.segment(from, count).maxCoeff(); };
        const double left = std::clamp(about(by_grid) / about(before), 1. / 4,
                                       2. / 3), // share of an error on half the spacing
            error = about(by_steps) / 63 + about(by_grid) * left / (1 - left), value = 1 + finest[k],
                     down = finest[k] + value * ranges(k, 0) - error, up = finest[k] + value * ranges(k, 1) + error;
        decides[k] = std::abs(up) > std::abs(down) ? up : down;
        if (std::abs(decides[k]) > largest) largest = std::abs(decides[k]), at = pressures[static_cast<std::size_t>(k)];
    }
    const auto rows = app::csv_rows(rough::read_whole(folder / "r" / "points.csv")); // and their header
    double drawn = 0;                                                                // largest misfit in the picture
    for (std::size_t k = 1; k < rows.size(); ++k) drawn = std::max(drawn, std::abs(std::stod(rows[k].back())));
    CHECK(drawn == Approx(largest).epsilon(1e-6));
    const double lowest = 1 - largest;
    const auto says = [&](const char* fact, const std::vector<double>& expected,
                          double error = 6e-3) { // three digits
        const std::string text = std::string(fact) == "verdict" ? result["verdict"] : summary[fact];
        const std::vector<double> found = numbers_in(text);
        INFO(fact << ": " << text);
        REQUIRE(found.size() >= expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) CHECK(found[i] == Approx(expected[i]).epsilon(error));
    };
    CAPTURE(checks);
    REQUIRE(lowest < 0.99); // so that the screen names the obstacles
    for (const auto& [key, value] :
         {std::pair("similarity", checks[0]), {"similarity_refined", checks[1]}, {"similarity_worst", lowest}})
        if (variant.contains(key)) CHECK(variant[key].get<double>() == Approx(value).margin(1e-8));
    CHECK(summary["lowest"].get<double>() == Approx(lowest).margin(1e-8));
    const std::string page = rough::read_whole(folder / "r" / "report.html");
    for (const double value : {0.99, checks[0], checks[1], lowest}) {
        char cell[32];
        std::snprintf(cell, sizeof cell, "%.5g", value);
        CHECK_THAT(page, Catch::Contains("<td>" + std::string(cell)));
    }
    says("verdict", {lowest, 0.99});

    says("matched", {lowest, 100 * (1 - lowest)});
    says("obstacles", {100 * largest, 1e3 * at}); // kPa
    says("not_requested", {100 * own.contact_fraction.tail(1)[0]});

    // 1/K grows by (2 L/(pi E*)) ln 4 with the datum, in the target too.
    const double compliance = 2 * length / (std::numbers::pi * modulus) * std::log(4);
    const double with_datum = 1 - design.misfits(design.response(z, 4 * length), compliance).cwiseAbs().maxCoeff();
    says("worst_case", {checks[0], checks[1], 4, checks[2], 64, checks[3], checks[3] - lowest, lowest, with_datum, 4});

    rough::Body body;
    body.effective_modulus = modulus;
    const rough::Profile profile{z, length / static_cast<double>(nodes - 1)};
    const double peak =
        solve_contact(profile, body, {own.displacement.tail(1)[0]}, {.states = true}).states[0].pressure.maxCoeff();
    says("yielding", {1e3 * peak, 100 * peak / modulus});

    constexpr Index dense = 20001;
    const auto extreme = [&](int order) { return design.heights(dense, order).cwiseAbs().maxCoeff(); };
    const Eigen::VectorXd all = design.heights(dense);
    says("making", {design.shortest_wave(), extreme(1), all.maxCoeff() - all.minCoeff(), 1 / extreme(2)}, 0.03);
    says("carries_over", {length, length});

    // The sentence on the tolerance at one level, then the levels that are not reached: "... is 0.93".
    std::smatch words;
    const std::string machine = summary["machine"];
    INFO(machine);
    const std::regex sizes(
        "similarity stays at least ([0-9.]+) under one of these errors: noise of ([0-9.]+) (\\S+) rms at a "
        "correlation length of ([0-9.]+) (\\S+) \\(95 % of draws\\), a tilt of ([0-9.]+) (\\S+), or an "
        "error of scale of ([0-9.]+) %.*");
    REQUIRE(std::regex_match(machine, words, sizes));
    const auto number = [&](std::size_t i) { return std::stod(words[i]); };
    const double level = number(1), noise = in_program_units(number(2), words[3]),
                 tilt = in_program_units(number(6), words[7]), scale = number(8) / 100;
    CHECK(in_program_units(number(4), words[5]) == Approx(length / 60).epsilon(6e-3));
    const Eigen::VectorXd slope = Eigen::VectorXd::LinSpaced(nodes, 0, tilt), stretch = scale * z;
    // Errors change the curve of the verdict by the factor by which they change that of the search grid.
    const Eigen::ArrayXd factor = (1 + decides.array()) / (1 + design.misfits(own).array());
    const auto similarity = [&](const Eigen::VectorXd& heights) {
        return 1 - (factor * (1 + design.misfits(design.response(heights)).array()) - 1).abs().maxCoeff();
    };
    for (const Eigen::VectorXd& error : {slope, stretch}) {
        const auto with = [&](double times) {
            return std::min(similarity(z + times * error), similarity(z - times * error));
        };
        CHECK(with(0.99) >= level);
        CHECK(with(1.03) < level);
    }
    int kept = 0;
    for (std::uint64_t draw = 0; draw < 1000; ++draw)
        kept += similarity(z + noise * rough::height_noise({nodes, length}, length / 60, 1000 + draw)) >= level;
    CHECK(kept >= 920);
    CHECK(kept <= 980);
    if (const std::size_t rest = machine.find("is "); rest != std::string::npos)
        CHECK(std::stod(machine.substr(rest + 3)) == Approx(lowest).epsilon(1e-3));
    for (const json& one : variant["tolerance"]["levels"])
        if (one["similarity"] == level) CHECK(one["noise_rms_mm"].get<double>() == Approx(noise).epsilon(6e-3));
}
