#include "domain/profile/preparation.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

#include <Eigen/LU>

using namespace rough;

TEST_CASE("the Gaussian filter passes cosines by the standard's law") {
    const double cut_off = 0.8, pi = std::numbers::pi;
    for (const double length : {0.25, 0.4, 0.8, 1.6, 2.5, 8.0})
        for (const double phase : {0.0, 1.1}) {
            const auto wave = [&](double x) { return 3e-3 * std::cos(2 * pi * x / length + phase); };
            const Profile profile = sampled({4001, 8}, wave);
            const Eigen::VectorXd passed = low_passed(profile, cut_off);
            const double share = std::pow(2, -std::pow(cut_off / length, 2)); // ISO 16610-21, eq. (4)
            for (Index i = 401; i < 3600; ++i)                                // a window away from the ends
                REQUIRE(passed[i] == Approx(share * profile.heights[i]).margin(3e-3 * 2e-6));
        }
}

TEST_CASE("a line passes the filter up to its ends at any cut-off") {
    const Profile line = sampled({701, 2.1}, [](double x) { return 5 - 0.3 * x; });
    for (const double cut_off : {0.0001, 0.003, 0.01, 0.8, 2.5, 100.0})
        CHECK((low_passed(line, cut_off) - line.heights).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("the filter agrees with weighted least squares up to the ends") {
    std::mt19937_64 random(3);
    const Profile profile = sample(testing::random_genome(random, 2, 3, 0.84942, 0.84942 / 30), {.nodes = 150});
    const double cut_off = 0.2, alpha = std::sqrt(std::log(2.0) / std::numbers::pi);
    const Eigen::VectorXd passed = low_passed(profile, cut_off);
    for (const Index i : {0, 1, 17, 80, 149}) {
        Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
        Eigen::Vector2d right = Eigen::Vector2d::Zero();
        for (Index j = 0; j < 150; ++j) {
            const double x = double(j - i) * profile.spacing;
            if (std::abs(x) > cut_off) continue;
            const double weight = std::exp(-std::numbers::pi * std::pow(x / (alpha * cut_off), 2));
            const Eigen::Vector2d row(1, x);
            normal += weight * row * row.transpose();
            right += weight * row * profile.heights[j];
        }
        CHECK(passed[i] == Approx(normal.inverse().row(0) * right).epsilon(1e-10));
    }
}
