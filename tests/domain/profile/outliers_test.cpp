#include "domain/profile/preparation.hpp"
#include "tests/catch.hpp"
#include "tests/domain/accuracy/scans.hpp"

using namespace rough;

namespace {

Eigen::VectorXd made(Index nodes, auto height) {
    Eigen::VectorXd heights(nodes);
    for (Index i = 0; i < nodes; ++i) heights[i] = height(double(i));
    return heights;
}

double cycle(double x) { return x - std::floor(x); }

} // namespace

TEST_CASE("raised and lowered nodes are found, and no other nodes") {
    const double pi = std::numbers::pi;
    Eigen::VectorXd z = made(4096, [&](double i) {
        const double x = i / 4096;
        return std::cos(2 * pi * x) + 0.3 * std::cos(10 * pi * x + 1);
    });
    CHECK(outliers(z).empty());
    const Eigen::VectorXd clean = z;
    z[1364] += 1;
    z[2000] -= 0.2, z[2001] -= 0.25;
    CHECK(outliers(z) == std::vector<Index>{1364, 2000, 2001});
    CHECK((interpolated(z, outliers(z)) - clean).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("sharp profiles have no outliers at any position of the nodes") {
    for (const Index nodes : {40, 400, 3001})
        for (const double shift : {0.0, 0.3, 0.77}) {
            const double n = double(nodes);
            INFO(nodes << " nodes, shift " << shift);
            const auto expect_none = [&](auto height) { CHECK(outliers(made(nodes, height)).empty()); };
            expect_none([&](double i) { return -std::abs(i - n / 2 - shift); });
            expect_none([&](double i) { return std::max(0., 9 - std::abs(i - n / 2 - shift)); });
            expect_none([&](double i) { return i > n / 2 + shift ? 1. : 0.; });
            expect_none([&](double i) { return i > 2 + shift ? 1. : 0.; });
            expect_none([&](double i) { return cycle(i / 19 + shift); });
            expect_none([&](double i) { return -cycle(i / 23 + shift); });
            expect_none([&](double i) { return cycle(i / 20 + shift) < 0.4 ? 1. : 0.; });
            expect_none([&](double i) { return std::abs(std::cos(i / 30 + shift)); });
            expect_none([&](double i) { return std::round(3 * std::sin(i / 40 + shift)); });
        }
}

TEST_CASE("a particle is found with its flanks, up to the surface") {
    const Eigen::VectorXd clean = made(600, [](double i) { return std::cos(i / 40) + 0.01 * std::sin(7 * i); });
    for (const double sign : {1., -1.}) {
        Eigen::VectorXd z = clean;
        const std::array shape{0.06, 0.4, 1., 0.9, 0.5, 0.07};
        for (std::size_t i = 0; i < shape.size(); ++i) z[300 + Index(i)] += 2 * sign * shape[i];
        CHECK(outliers(z) == std::vector<Index>{300, 301, 302, 303, 304, 305});
        CHECK((interpolated(z, outliers(z)) - clean).cwiseAbs().maxCoeff() < 0.03);
    }
}

TEST_CASE("a particle on a scan is found with all of its nodes and no other nodes") {
    int particles = 0, whole = 0, cut = 0, beside = 0;
    for (unsigned seed = 9300; seed < 9360; ++seed) {
        std::mt19937_64 random(seed);
        Eigen::VectorXd z =
            testing::random_scan(random, std::array{0, 1, 2, 3, 6}[seed % 5], 500, 3000).profile.heights;
        beside += int(outliers(z).size());
        const double step = (z.tail(z.size() - 1) - z.head(z.size() - 1)).cwiseAbs().mean(),
                     height = 60 * step + z.maxCoeff() - z.minCoeff();
        std::vector<std::pair<Index, Index>> at;
        for (Index i = 60; i + 60 < z.size(); i += 97) {
            const Index width = 1 + i % 4;
            z.segment(i, width).array() += height; // its top follows the surface under it
            at.emplace_back(i, width);
        }
        const auto found = outliers(z);
        for (const auto& [first, width] : at) {
            const auto is_found = [&](Index i) { return std::binary_search(found.begin(), found.end(), i); };
            Index inside = 0;
            for (Index i = first; i < first + width; ++i) inside += is_found(i);
            ++particles;
            whole += inside == width && !is_found(first - 1) && !is_found(first + width);
            cut += inside > 0 && inside < width;
        }
    }
    INFO(whole << " of " << particles << " found whole, " << cut << " cut");
    CHECK(whole >= 0.98 * particles);
    CHECK(cut == 0);
    CHECK(beside <= 5); // in 100,000 nodes of scans without a particle
}
