#include "domain/profile/outliers.hpp"
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

std::vector<Index> outliers_of(const Eigen::VectorXd& heights) { return outliers(Profile{heights, 1}); }

double cycle(double x) { return x - std::floor(x); }

/// A smooth map with a fine texture, of random waves.
Profile random_map(std::mt19937_64& random, Index columns, Index rows) {
    std::uniform_real_distribution<> any(-1, 1);
    Profile map{Eigen::VectorXd::Zero(columns * rows), 0.01, rows, 0.02};
    for (const double wave : {60., 25., 9., 4.}) {
        const double angle = 4 * any(random), phase = 4 * any(random);
        for (Index node = 0; node < map.nodes(); ++node)
            map.heights[node] +=
                wave / 60 *
                std::cos(7 / wave *
                             (std::cos(angle) * double(node % columns) + std::sin(angle) * double(node / columns)) +
                         phase);
    }
    return map;
}

} // namespace

TEST_CASE("raised and lowered nodes are found, and no other nodes") {
    const double pi = std::numbers::pi;
    Eigen::VectorXd z = made(4096, [&](double i) {
        const double x = i / 4096;
        return std::cos(2 * pi * x) + 0.3 * std::cos(10 * pi * x + 1);
    });
    CHECK(outliers_of(z).empty());
    const Eigen::VectorXd clean = z;
    z[1364] += 1;
    z[2000] -= 0.2, z[2001] -= 0.25;
    CHECK(outliers_of(z) == std::vector<Index>{1364, 2000, 2001});
    CHECK((interpolated(z, outliers_of(z)) - clean).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("sharp profiles have no outliers at any position of the nodes") {
    for (const Index nodes : {40, 400, 3001})
        for (const double shift : {0.0, 0.3, 0.77}) {
            const double n = double(nodes);
            INFO(nodes << " nodes, shift " << shift);
            const auto expect_none = [&](auto height) { CHECK(outliers_of(made(nodes, height)).empty()); };
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
        CHECK(outliers_of(z) == std::vector<Index>{300, 301, 302, 303, 304, 305});
        CHECK((interpolated(z, outliers_of(z)) - clean).cwiseAbs().maxCoeff() < 0.03);
    }
}

TEST_CASE("a particle on a scan is found with all of its nodes and no other nodes") {
    int particles = 0, whole = 0, cut = 0, beside = 0;
    for (unsigned seed = 9300; seed < 9360; ++seed) {
        std::mt19937_64 random(seed);
        Eigen::VectorXd z =
            testing::random_scan(random, std::array{0, 1, 2, 3, 6}[seed % 5], 500, 3000).profile.heights;
        beside += int(outliers_of(z).size());
        const double step = (z.tail(z.size() - 1) - z.head(z.size() - 1)).cwiseAbs().mean(),
                     height = 60 * step + z.maxCoeff() - z.minCoeff();
        std::vector<std::pair<Index, Index>> at;
        for (Index i = 60; i + 60 < z.size(); i += 97) {
            const Index width = 1 + i % 4;
            z.segment(i, width).array() += height; // its top follows the surface under it
            at.emplace_back(i, width);
        }
        const auto found = outliers_of(z);
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

TEST_CASE("spikes at the ends are outliers, the steps of levelled digital heights are not") {
    Eigen::VectorXd z(200), digital(400);
    for (Index i = 0; i < z.size(); ++i) z[i] = std::sin(0.1 * double(i)) + 0.05 * std::sin(37. * double(i * i));
    CHECK(outliers_of(z).empty());
    for (const Index node : {0, 1, 2, 197, 198, 199}) {
        Eigen::VectorXd spiked = z;
        spiked[node] = 1000;
        CHECK(outliers_of(spiked) == std::vector<Index>{node});
    }
    for (Index i = 0; i < digital.size(); ++i)
        digital[i] = 0.0129 * std::round(std::sin(0.02 * double(i)) / 0.0129 * 0.3 + 0.4 * std::sin(double(i * i))) -
                     1.4e-6 * double(i);
    CHECK(outliers_of(digital).empty());
    digital[200] += 1;
    CHECK(outliers_of(digital) == std::vector<Index>{200});
}

TEST_CASE("a particle on a map is found with all of its nodes, from every side") {
    std::mt19937_64 random(2200);
    for (int trial = 0; trial < 12; ++trial) {
        const Index columns = 80 + 7 * trial, rows = 150 - 5 * trial;
        const Profile clean = random_map(random, columns, rows);
        CHECK(outliers(clean).empty());
        Profile map = clean;
        std::vector<Index> expected;
        const auto raise = [&](Index column, Index row, Index width, Index height) {
            for (Index j = row; j < row + height; ++j)
                for (Index i = column; i < column + width; ++i) {
                    map.heights[j * columns + i] += trial % 2 ? 9 : -9;
                    expected.push_back(j * columns + i);
                }
        };
        raise(20, 30, 1 + trial % 4, 1 + trial / 3), raise(50, 60, 3, 1), raise(60, 75, 2, 4);
        raise(0, 20, 1, 1), raise(columns - 1, rows - 1, 1, 1), raise(40, 0, 1, 2);
        std::ranges::sort(expected);
        INFO("trial " << trial);
        CHECK(outliers(map) == expected);
        CHECK((without(map, expected).heights - clean.heights).cwiseAbs().maxCoeff() < 0.5);

        std::vector<Index> turned; // rows and columns exchanged
        for (const Index node : expected) turned.push_back(node % columns * rows + node / columns);
        std::ranges::sort(turned);
        const Eigen::VectorXd across = map.heights.reshaped(columns, rows).transpose().reshaped();
        CHECK(outliers({across, 0.02, columns, 0.01}) == turned);
    }
}

TEST_CASE("scratches, ridges, pyramids and steps of a map are no outliers in any direction") {
    std::mt19937_64 random(2201);
    for (int trial = 0; trial < 36; ++trial) {
        const double angle = std::numbers::pi * trial / 36, width = 0.8 + trial % 5;
        const auto [x, y] = std::pair(std::cos(angle), std::sin(angle));
        for (const double height : {5., -5.}) {
            Profile map = random_map(random, 120, 100);
            for (Index node = 0; node < map.nodes(); ++node) {
                const double along = x * double(node % 120 - 60) + y * double(node / 120 - 50),
                             across = y * double(node % 120 - 55) - x * double(node / 120 - 50);
                map.heights[node] += height * std::max(0., 1 - std::abs(across) / width);
                if (trial % 3 == 0) map.heights[node] += height * std::max(0., 1 - std::abs(along) / width); // crossed
                if (trial % 3 == 1) map.heights[node] += along > 20 ? height : 0;
                if (trial % 3 == 2)
                    map.heights[node] += height * std::max(0., 1 - (std::abs(along - 9) + std::abs(across - 20)) / 10);
            }
            INFO("angle " << angle << ", width " << width << ", height " << height);
            CHECK(outliers(map).empty());
        }
    }
}

TEST_CASE("an array of pins has no outliers") {
    Profile map{Eigen::VectorXd(128 * 128), 1, 128, 1};
    for (Index i = 0; i < map.nodes(); ++i)
        map.heights[i] = std::max(0., 3 - std::hypot(double(i % 128 % 16) - 8, double(i / 128 % 16) - 8));
    CHECK(outliers(map).empty());
}
