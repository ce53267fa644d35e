#include "domain/contact/solvers/cascade.hpp"
#include "domain/contact/solvers/extension.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <random>

using namespace rough;

namespace {

/// Of a grid with odd and even sides, a few of its nodes.
struct Scene {
    Extent shape;
    std::vector<int> nodes;
    explicit Scene(Extent extent) : shape(extent) {
        std::mt19937 random(7);
        for (int i = 0; i < shape.nodes(); ++i)
            if (random() % 6 == 0 || i == shape.nodes() / 2)
                nodes.push_back(i);
    }
    std::vector<float> field() const { return std::vector<float>(static_cast<std::size_t>(shape.nodes())); }
};

const std::vector<Extent> shapes{{64, 32}, {27, 35}, {48, 5}, {9, 1}, {2, 3}, {1, 1}};

} // namespace

TEST_CASE("a field continued off its nodes keeps what it is there, and stays between its least and most",
          "[contact][areas]") {
    for (const Extent shape : shapes) {
        const Scene scene(shape);
        std::vector<float> field = scene.field();
        std::mt19937 random(3);
        for (const int i : scene.nodes)
            field[static_cast<std::size_t>(i)] = static_cast<float>(1 + random() % 100);
        const std::vector<float> before = field;
        float least = 1000, most = 0;
        for (const int i : scene.nodes) {
            least = std::min(least, field[static_cast<std::size_t>(i)]);
            most = std::max(most, field[static_cast<std::size_t>(i)]);
        }
        Extension(shape, scene.nodes).extend(field.data());
        for (const int i : scene.nodes)
            CHECK(field[static_cast<std::size_t>(i)] == before[static_cast<std::size_t>(i)]);
        const auto [low, high] = std::minmax_element(field.begin(), field.end());
        CHECK(*low >= least * (1 - 1e-5F)); // so a constant stays one
        CHECK(*high <= most * (1 + 1e-5F));
    }
}

TEST_CASE("carrying a field over to the nodes is the transpose of continuing it", "[contact][areas]") {
    for (const Extent shape : shapes) {
        const Scene scene(shape);
        std::vector<float> given = scene.field(), load = scene.field();
        std::mt19937 random(5);
        for (const int i : scene.nodes)
            given[static_cast<std::size_t>(i)] = static_cast<float>(random() % 100);
        for (float& value : load)
            value = static_cast<float>(random() % 100);
        std::vector<float> continued = given, carried = load;
        Extension extension(shape, scene.nodes);
        extension.extend(continued.data());
        extension.transpose(carried.data());
        double all = 0, there = 0;
        for (std::size_t i = 0; i < load.size(); ++i)
            all += static_cast<double>(continued[i]) * static_cast<double>(load[i]);
        for (const int i : scene.nodes)
            there += static_cast<double>(given[static_cast<std::size_t>(i)]) *
                     static_cast<double>(carried[static_cast<std::size_t>(i)]);
        CHECK(there == Approx(all).epsilon(1e-5));
    }
}

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

TEST_CASE("NNLS drops what an earlier step pressed and the next does not bear", "[contact]") {
    const auto pressures = [](const StepSolution& step) {
        std::map<int, double> at;
        for (std::size_t k = 0; k < step.nodes.size(); ++k)
            at[step.nodes[k]] = step.pressure[static_cast<Index>(k)];
        return at;
    };
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        const Profile profile = scenes::database(120)[0];
        ContactProblem problem = make_problem(profile, {kernel, 1.0}, scenes::load_steps(profile, 9, 0.3));
        Solution pressed, released;
        solve_nnls(problem, {}, pressed);
        std::reverse(problem.approach.begin(), problem.approach.end());
        solve_nnls(problem, {}, released); // from the most nodes to the fewest
        const std::size_t n = problem.approach.size();
        REQUIRE(pressed.steps.back().nodes.size() > pressed.steps.front().nodes.size() + 8);
        for (std::size_t k = 0; k < n; ++k) {
            const auto up = pressures(pressed.steps[k]), down = pressures(released.steps[n - 1 - k]);
            REQUIRE(up.size() == down.size());
            const double most = pressed.steps[k].pressure.maxCoeff();
            for (const auto& [node, pressure] : up)
                CHECK(down.at(node) == Approx(pressure).margin(1e-9 * most));
            CHECK(released.steps[n - 1 - k].stiffness == Approx(pressed.steps[k].stiffness).epsilon(1e-9));
        }
    }
}
