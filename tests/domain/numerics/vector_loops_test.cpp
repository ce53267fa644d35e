#include "domain/numerics/aligned.hpp"
#include "domain/numerics/team.hpp"
#include "domain/numerics/vector_loops.hpp"
#include "tests/catch.hpp"

#include <Eigen/Cholesky>

#include <limits>

using namespace rough;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

std::vector<const VectorLoops*> kinds() {
    std::vector<const VectorLoops*> all;
    for (const char* name : {"baseline", "avx2", "avx512"})
        if (const VectorLoops* loops = vector_loops(name)) all.push_back(loops);
    return all;
}

/// Numbers in [-1, 1] without a pattern.
double number(Index i) { return std::sin(static_cast<double>(i * i % 1009) + 0.3 * static_cast<double>(i)); }

} // namespace

TEST_CASE("the widest vectors of the processor are taken and recorded", "[vectors]") {
    REQUIRE(vector_loops("baseline"));
    CHECK_FALSE(vector_loops("none"));
    if (!std::getenv("RUGOSA_VECTORS")) CHECK(std::string(vector_loops().vectors) == kinds().back()->vectors);
    CHECK(build().vectors == vector_loops().vectors);
    CHECK_FALSE(build().compiler.empty());
}

TEST_CASE("a factor's panels solve a linear system with any kind of vectors", "[vectors]") {
    constexpr Index n = 3 * panel_width;
    MatrixXd A(n, n);
    VectorXd gap(n);
    for (Index i = 0; i < n; ++i) {
        gap[i] = number(i);
        for (Index j = 0; j < n; ++j)
            A(i, j) = std::exp(-0.3 * std::abs(static_cast<double>(i - j))) + (i == j ? 0.5 : 0);
    }
    const VectorXd exact = A.llt().solve(VectorXd::Ones(n) - gap);
    for (const VectorLoops* loops : kinds()) {
        INFO(loops->vectors);
        std::vector<AlignedBuffer<double>> memory;
        std::vector<double*> panels;
        std::vector<double> inverse(n), one(n), image(n);
        const PanelFactor factor = [&] {
            for (Index b = 0; b < n / panel_width; ++b) {
                memory.emplace_back(panel_width * panel_width * (b + 1));
                panels.push_back(memory.back().data());
            }
            return PanelFactor{panels.data(), inverse.data(), one.data(), image.data()};
        }();
        for (Index b = 0; b < n / panel_width; ++b) {
            const Index first = b * panel_width;
            MatrixXd::Map(panels[static_cast<std::size_t>(b)], panel_width, first + panel_width) =
                A.block(first, 0, panel_width, first + panel_width);
            const VectorXd ones = VectorXd::Ones(panel_width);
            REQUIRE(loops->eliminate(factor, b, 0, ones.data(), gap.data() + first, 1e-10) == panel_width);
        }
        VectorXd x = VectorXd::Map(one.data(), n) - VectorXd::Map(image.data(), n);
        loops->back_substitute(factor, n / panel_width, x.data());
        CHECK((x - exact).cwiseAbs().maxCoeff() < 1e-13);
        // A row that repeats another has no pivot.
        MatrixXd::Map(panels[0], panel_width, panel_width).setOnes();
        const VectorXd ones = VectorXd::Ones(panel_width);
        CHECK(loops->eliminate(factor, 0, 0, ones.data(), gap.data(), 1e-10) == 1);
    }
}

TEST_CASE("products agree with Eigen for any kind of vectors", "[vectors]") {
    constexpr Index depth = 45, width = panel_width, size = 128;
    AlignedBuffer<double> rows(width * depth);
    for (Index i = 0; i < width * depth; ++i) rows[i] = number(i);
    MatrixXd columns(depth + 2, width);
    for (Index i = 0; i < columns.size(); ++i) columns(i) = number(7 * i + 1);
    const MatrixXd expected = MatrixXd::Map(rows.data(), width, depth) * columns.topRows(depth);

    const Eigen::Vector3d p(1, -2, 0.5);
    VectorXd h(2 * size);
    for (Index i = 0; i < h.size(); ++i) h[i] = number(3 * i);
    const std::vector<int> nodes{0, 40, 127};

    for (const VectorLoops* loops : kinds()) {
        INFO(loops->vectors);
        MatrixXd product(width, width);
        loops->multiply(rows.data(), depth, columns.data(), columns.rows(), product.data());
        CHECK((product - expected).cwiseAbs().maxCoeff() < 1e-13);
        VectorXd u(size);
        loops->toeplitz(h.data() + size, size, nodes.data(), p.data(), 3, u.data());
        for (Index i = 0; i < size; ++i)
            CHECK(u[i] == Approx(h[size + i] - 2 * h[size + i - 40] + 0.5 * h[size + i - 127]).margin(1e-14));
    }
}

TEST_CASE("a team that the system cannot start is the caller's thread alone", "[vectors]") {
    pthread_attr_t usual, vast; // stacks larger than the memory that a process can address
    pthread_getattr_default_np(&usual), pthread_attr_init(&vast);
    pthread_attr_setstacksize(&vast, std::size_t{1} << 60);
    pthread_setattr_default_np(&vast);
    const Team team(2000);
    pthread_setattr_default_np(&usual);
    CHECK(team.size() == 1);
}

TEST_CASE("a wave is the cosine of its angle for any kind of vectors", "[vectors]") {
    constexpr Index nodes = 75, block = 32;
    const double step = 0.07, phase = 0.4;
    VectorXd start_cosines(3), start_sines(3), fine_cosines(block), fine_sines(block);
    for (Index b = 0; b < 3; ++b) {
        const double angle = phase + step * static_cast<double>(block * b);
        start_cosines[b] = std::cos(angle), start_sines[b] = std::sin(angle);
    }
    for (Index j = 0; j < block; ++j) {
        const double angle = step * static_cast<double>(j);
        fine_cosines[j] = std::cos(angle), fine_sines[j] = std::sin(angle);
    }
    const WaveAngles angles{
        nodes, block, start_cosines.data(), start_sines.data(), fine_cosines.data(), fine_sines.data()};
    for (const VectorLoops* loops : kinds()) {
        INFO(loops->vectors);
        VectorXd heights = VectorXd::Constant(nodes + 1, 10), cosines(nodes), sines(nodes);
        loops->add_wave(angles, 2, 3, heights.data());
        loops->wave(angles, cosines.data(), sines.data());
        for (Index i = 0; i < nodes; ++i) {
            const double angle = phase + step * static_cast<double>(i);
            CHECK(heights[i] == Approx(12 - 3 * std::cos(angle)).epsilon(1e-14));
            CHECK(cosines[i] == Approx(std::cos(angle)).margin(1e-14));
            CHECK(sines[i] == Approx(std::sin(angle)).margin(1e-14));
        }
        CHECK(heights[nodes] == 10);
    }
}
