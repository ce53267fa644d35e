#include "domain/numerics/statistics.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rough;

TEST_CASE("quantiles are read between the values in order, and what is unknown does not count") {
    const double nan = std::nan("");
    CHECK(quantile({4, 1, nan, 2, 3}, 0) == 1);
    CHECK(quantile({4, 1, nan, 2, 3}, 1) == 4);
    CHECK(quantile({4, 1, nan, 2, 3}, 0.1) == Approx(1.3));
    CHECK(median({4, 1, 2, 3}) == Approx(2.5));
    CHECK(median({3, nan, 1}) == 2);
    CHECK(mean({1, nan, 2, 6}) == 3);
    CHECK(std::isnan(median({})));
    CHECK(std::isnan(mean({nan})));
}

TEST_CASE("a line's slope is found again, and two points are the fewest") {
    CHECK(slope(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(5, 3, 1)) == Approx(-2));
    CHECK(slope(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 3, 0)) == Approx(0).margin(1e-15));
    CHECK(std::isnan(slope(Eigen::VectorXd(1), Eigen::VectorXd(1))));
}

TEST_CASE("series that vary together correlate fully, and none correlates with a constant") {
    CHECK(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(2, 4, 6)) == Approx(1));
    CHECK(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(3, 2, 1)) == Approx(-1));
    CHECK(std::isnan(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(7, 7, 7))));
    CHECK(std::isnan(pearson(Eigen::Array3d(1, 2, 3), Eigen::Array3d(7, 7 + 1e-15, 7))));
    CHECK(std::isnan(pearson(1e6 * Eigen::Array3d(1, 2, 3), Eigen::Array3d(7e6, 7e6 + 1e-9, 7e6))));
    for (const double size : {1e-12, 1e12}) // whatever their units
        CHECK(pearson(size * Eigen::Array3d(1, 2, 3), Eigen::Array3d(2, 4, 6) / size) == Approx(1));
}

TEST_CASE("a quantile moves evenly from one value to the next, and of one value is that value") {
    for (const double share : {0.0, 0.25, 0.5, 0.625, 1.0})
        CHECK(quantile({9, 1, 5}, share) == Approx(1 + 8 * share));
    CHECK(quantile({7}, 0.9) == 7);
    CHECK(std::isnan(quantile({std::nan("")}, 0.5)));
}

TEST_CASE("a column is a member of each row, or what a function says of it, in the rows' order") {
    struct Row {
        double value;
        double doubled() const { return 2 * value; }
    };
    const std::vector<Row> rows{{3}, {1}, {2}};
    CHECK(column(rows, &Row::value) == std::vector<double>{3, 1, 2});
    CHECK(column(rows, &Row::doubled) == std::vector<double>{6, 2, 4});
    CHECK(column(rows, [](const Row& row) { return -row.value; }) == std::vector<double>{-3, -1, -2});
}
