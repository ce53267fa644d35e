#include "ga/base/random.hpp"
#include "ga/pareto/hypervolume.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

std::vector<Point> points(std::size_t n, std::size_t objectives, std::uint64_t seed) {
    Stream stream(seed);
    std::vector<Point> points(n, Point(objectives));
    for (auto& point : points)
        for (double& value : point)
            value = static_cast<double>(stream.below(12)); // ties included
    return points;
}

} // namespace

TEST_CASE("ranks peel off one front after the other, as by the definition") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const auto cloud = points(40, 2 + seed % 3, seed);
        std::vector<std::size_t> expected(cloud.size(), 99);
        for (std::size_t front = 0, left = cloud.size(); left > 0; ++front) {
            std::vector<std::size_t> members;
            for (std::size_t i = 0; i < cloud.size(); ++i) {
                bool dominated = false;
                for (std::size_t j = 0; j < cloud.size(); ++j)
                    dominated |= expected[j] >= front && dominates(cloud[j], cloud[i]);
                if (expected[i] == 99 && !dominated)
                    members.push_back(i);
            }
            for (const std::size_t i : members)
                expected[i] = front;
            left -= members.size();
        }
        CHECK(pareto_ranks(cloud) == expected);
    }
}

TEST_CASE("the ends of a front have endless room, the others the sides of their box") {
    const std::vector<Point> front = {{0, 4}, {1, 3}, {3, 1}, {4, 0}};
    const auto room = crowding_distances(front, {0, 0, 0, 0});
    CHECK(std::isinf(room[0]));
    CHECK(std::isinf(room[3]));
    CHECK(room[1] == Approx(3.0 / 4 + 3.0 / 4));
    CHECK(room[2] == Approx(3.0 / 4 + 3.0 / 4));
}

TEST_CASE("the dominated share of many objectives grows with what is dominated and ignores what is not") {
    Stream stream(9);
    const Point reference(5, 0), width(5, 1);
    CHECK(dominated_share({}, reference, width) == 0);
    CHECK(dominated_share({Point(5, 1e9)}, reference, width) == 1);
    std::vector<Point> points;
    double before = 0;
    for (int i = 0; i < 20; ++i) {
        Point point(5);
        for (double& value : point)
            value = 3 * stream.uniform();
        points.push_back(point);
        const double share = dominated_share(points, reference, width);
        CHECK(share >= before);
        before = share;
        Point dominated = point;
        dominated[0] *= 0.5;
        auto more = points;
        more.push_back(dominated);
        CHECK(dominated_share(more, reference, width) == share);
    }
    CHECK(before > 0);
}
