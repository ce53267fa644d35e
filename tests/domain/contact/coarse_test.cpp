#include "domain/contact/solvers/advance.hpp"
#include "domain/contact/solvers/cascade.hpp"
#include "domain/contact/solvers/problem.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("a problem coarsened is that of the profile of every fourth node, in the same units of length",
          "[contact]") {
    for (const Kernel kernel : {Kernel::free, Kernel::strip, Kernel::periodic}) {
        const Index nodes = kernel == Kernel::periodic ? 32 : 33;
        const Body body{kernel, 1.7, 5, 0.02};
        Profile profile{Eigen::VectorXd(nodes), 0.1}, every{Eigen::VectorXd((nodes + 3) / 4), 0.4};
        for (Index i = 0; i < nodes; ++i)
            profile.heights[i] = std::cos(0.7 * static_cast<double>(i)); // highest at the first node
        every.heights = profile.heights(Eigen::seqN(0, every.nodes(), 4));
        const ContactProblem coarse = coarsened(make_problem(profile, body, {0.01, 0.03}), 4),
                             own = make_problem(every, body, {0.01, 0.03});
        CHECK(coarse.gap == own.gap);
        CHECK(coarse.approach == own.approach);
        CHECK(coarse.datum == Approx(own.datum));
        CHECK(coarse.strip_width == Approx(own.strip_width));
        CHECK(coarse.column.isApprox(own.column, 1e-12));
        CHECK(coarse.elements == Approx(own.elements));
        CHECK(coarse.pressure_unit == Approx(own.pressure_unit));
        CHECK(coarse.displacement_unit == own.displacement_unit);
        CHECK(coarse.stiffness_unit == Approx(own.stiffness_unit));
    }
}

TEST_CASE("contact advances to a summit's upper two fifths, and beside contact node by node", "[contact]") {
    using Nodes = std::vector<int>;
    const auto advanced = [](std::initializer_list<double> depth, const Nodes& contact) {
        std::vector<char> touching(depth.size(), 0);
        for (const int i : contact)
            touching[static_cast<std::size_t>(i)] = 1;
        return advancing_nodes(Eigen::Map<const Eigen::ArrayXd>(depth.begin(), std::ssize(depth)), touching,
                               {std::ssize(depth)}, 0.5);
    };
    CHECK(advanced({0, 1, 2, 1.3, 1.1, 0}, {}) == Nodes{2, 3}); // surest first
    CHECK(advanced({0, 0.5, 0.4}, {}).empty());
    CHECK(advanced({0, 1, 1, 1, 0}, {0, 4}) == Nodes{1, 3, 2});
    CHECK(advanced({0, 1, 1, 1, 0}, {0}) == Nodes{1, 2, 3}); // three of three: 8/3 is the reach
    CHECK(advanced({0, 1, 1, 1, 1, 1, 1, 0}, {7}) == Nodes{6, 5, 4, 3, 2});
}
