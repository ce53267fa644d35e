#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/contact/kernel.hpp"
#include "tests/domain/accuracy/scans.hpp"

#include <catch2/catch.hpp>

#include <iostream>

using namespace rough;

namespace {

Model model_for(const Profile& scan, Kernel kernel, int steps) {
    Model model;
    const bool periodic = kernel == Kernel::periodic;
    const double length = profile_length(scan, kernel);
    model.grid = {scan.nodes(), length, periodic};
    model.body = {kernel, 1, length, length / 511};
    model.loading = {steps, periodic ? 0.95 : 1};
    return model;
}

Model at_any_tolerance(Model model) {
    model.contact.tolerance = 1; // follows from the accuracy, as in `contact`
    return model;
}

struct Coverage {
    int scans = 0, covered = 0;
    double worst = 0;     ///< error over accuracy
    double most_work = 0; ///< of a scan: load steps solved, over the exact curve's
    long steps = 0, exact_steps = 0;
};

/// Scans against their exact curves: pressure, secants and contact fractions.
Coverage coverage_of(unsigned first, unsigned count, double accuracy, int steps, Index least, Index most) {
    Coverage result;
    for (unsigned seed = first; seed < first + count; ++seed, ++result.scans) {
        std::mt19937_64 random(seed);
        const auto scan = testing::random_scan(random, static_cast<int>(seed), least, most);
        const Model model = model_for(scan.profile, static_cast<Kernel>(seed / 8 % 3), steps);
        const AccountedResponse exact = respond_exactly(scan.profile, model);
        const AccountedResponse cheap = respond_within(scan.profile, at_any_tolerance(model), accuracy);
        const double error = relative_error(cheap.response.pressure, exact.response.pressure);
        const Eigen::ArrayXd area = exact.response.contact_fraction;
        const double area_error = ((cheap.response.contact_fraction.array() - area).abs() / area).maxCoeff();
        const bool covered = error <= cheap.account.estimated_error + exact.account.estimated_error &&
                             area_error <= cheap.account.area_error + 1e-12;
        INFO(scan.kind << ", seed " << seed << ", error " << error << ", area " << area_error);
        CHECK(cheap.response.displacement == exact.response.displacement);
        CHECK(cheap.account.estimated_error <= accuracy);
        result.covered += covered;
        result.worst = std::max(result.worst, error / accuracy);
        // On the same nodes and by the same solver a load step costs as much as an exact one.
        CHECK(cheap.account.grids == exact.account.grids);
        result.most_work = std::max(result.most_work, static_cast<double>(cheap.account.solved_rows) /
                                                          exact.account.solved_rows);
        result.steps += cheap.account.solved_rows;
        result.exact_steps += exact.account.solved_rows;
    }
    return result;
}

} // namespace

TEST_CASE("one raised node of 4096 is not lost within an accuracy") {
    Profile scan{Eigen::VectorXd(4096), 0.25e-3};
    for (Index i = 0; i < 4096; ++i) {
        const double x = 6.283185307179586 * static_cast<double>(i) / 4096;
        scan.heights[i] = 1e-3 * (std::cos(x) + 0.3 * std::cos(5 * x + 1) + (i == 1364));
    }
    const Model model = model_for(scan, Kernel::periodic, 20);
    const AccountedResponse exact = respond_exactly(scan, model);
    for (const double accuracy : {1e-2, 1e-3}) {
        const AccountedResponse cheap = respond_within(scan, at_any_tolerance(model), accuracy);
        CHECK(relative_error(cheap.response.pressure, exact.response.pressure) <= accuracy);
        CHECK(cheap.account.estimated_error <= accuracy);
        CHECK(cheap.account.grids == std::vector<Index>{4096});
    }
}

TEST_CASE("what is said of a scan's curve within an accuracy holds, its contact fractions included") {
    for (const int steps : {20, 300}) {
        const Coverage found = coverage_of(7100000, 24, 1e-2, steps, 300, 1200);
        CHECK(found.covered == found.scans);
        CHECK(found.worst <= 1);
        CHECK(found.most_work <= 1.2);
    }
}

TEST_CASE("a scan's curve is within its accuracy at every load step, the lightest too") {
    std::mt19937_64 random(7300000);
    for (int which = 0; which < 8; ++which) {
        const auto scan = testing::random_scan(random, which, 300, 400);
        INFO(scan.kind);
        const Model model = model_for(scan.profile, static_cast<Kernel>(which % 3), 500);
        const Eigen::VectorXd exact = respond_exactly(scan.profile, model).response.pressure;
        const AccountedResponse cheap = respond_within(scan.profile, at_any_tolerance(model), 1e-2);
        const Eigen::VectorXd off = cheap.response.pressure - exact;
        CHECK(off.cwiseQuotient(exact).cwiseAbs().maxCoeff() <= 1e-2);
        CHECK(differences(off).cwiseQuotient(differences(exact)).cwiseAbs().maxCoeff() <= 1e-2);
        CHECK(cheap.account.light_rows == 0);
    }
}

TEST_CASE("a scan within an accuracy bears the loads that are given, whatever the solver's tolerance") {
    std::mt19937_64 random(7400000);
    const auto scan = testing::random_scan(random, 2, 900, 1000);
    Model model = model_for(scan.profile, Kernel::free, 20);
    const double highest = respond_exactly(scan.profile, model).response.pressure.tail(1)[0];
    model.loading.to_pressure = 0.3 * highest;
    const Response to_pressure = respond_within(scan.profile, at_any_tolerance(model), 0.1).response;
    CHECK(to_pressure.pressure.tail(1)[0] == Approx(0.3 * highest).epsilon(0.1));
    model.loading.to_pressure = 0;
    model.loading.pressures = {0.01 * highest, 0.2 * highest, 0.4 * highest};
    const AccountedResponse found = respond_within(scan.profile, at_any_tolerance(model), 1e-3);
    for (std::size_t j = 0; j < 3; ++j)
        CHECK(found.response.pressure[static_cast<Index>(j)] ==
              Approx(model.loading.pressures[j]).epsilon(1e-4));
    CHECK(found.account.rows == 3);
}

// 500 scans, seeds that nothing was tuned on; printed for the README.
TEST_CASE("what is said of 500 scans' curves holds for 98 % at least, at no more cost than exact", "[long]") {
    for (const double accuracy : {1e-2, 1e-3}) {
        const Coverage found = coverage_of(7200000, 500, accuracy, 20, 500, 4000);
        std::cout << "accuracy " << accuracy << ": covered " << found.covered << " of " << found.scans
                  << ", worst error " << found.worst << " accuracies; load steps solved " << found.steps
                  << " of " << found.exact_steps << ", at most " << found.most_work << " of a scan's\n";
        CHECK(found.covered >= 0.98 * found.scans);
        CHECK(found.worst < 3);
        CHECK(found.most_work <= 1.2);
    }
}
