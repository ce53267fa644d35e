#include "domain/contact/kernel.hpp"
#include "domain/contact/solvers/influence.hpp"
#include "domain/numerics/fourier.hpp"
#include "tests/catch.hpp"

using namespace rough;

namespace {

/// Compares every method of applying the influence matrix, on all nodes and on some of them, with its direct
/// sums.
void check_paths(const UnitBody& body, Extent shape) {
    const Eigen::VectorXd column = influence_column(body, shape);
    const Index nodes = shape.nodes();
    const Eigen::VectorXd p = Eigen::VectorXd::Random(nodes).cwiseAbs();
    const auto direct = [&](const Eigen::VectorXd& pressure) {
        Eigen::VectorXd sums = Eigen::VectorXd::Zero(nodes);
        for (Index i = 0; i < nodes; ++i)
            for (Index k = 0; k < nodes; ++k)
                sums[i] += pressure[k] * column[std::abs(i / shape.columns - k / shape.columns) * shape.columns +
                                                std::abs(i % shape.columns - k % shape.columns)];
        return sums;
    };
    Eigen::VectorXd expected = direct(p);
    const double rounding = 1e-14 * column.cwiseAbs().sum();
    const auto apply = [&](FourierOperator op) {
        std::copy_n(p.data(), nodes, op.input());
        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(op.apply(), nodes));
    };
    SingleFourierOperator single = SingleFourierOperator::toeplitz(column, shape);
    Eigen::VectorXf::Map(single.input(), nodes) = p.cast<float>();
    const Eigen::VectorXf rounded = Eigen::VectorXf::Map(single.apply(), nodes);
    CHECK((rounded.cast<double>() - expected).cwiseAbs().maxCoeff() < 1e-6 * column.cwiseAbs().sum());
    const auto error = [&](const Eigen::VectorXd& u) { return (u - expected).cwiseAbs().maxCoeff(); };
    CHECK(error(apply(FourierOperator::toeplitz(column, shape))) < rounding);
    CHECK(error(SplitOperator(column, shape).apply(p)) < rounding);
    if (body.kernel == Kernel::periodic)
        CHECK(error(apply(FourierOperator::circulant(shape, periodic_spectrum(body, shape)))) < rounding);
    std::vector<int> some;
    Eigen::VectorXd on_some(nodes), elsewhere = Eigen::VectorXd::Zero(nodes);
    for (Index i = nodes - 1; i >= 0; i -= 1 + i % 3) { // in any order
        on_some[static_cast<Index>(some.size())] = elsewhere[i] = p[i];
        some.push_back(static_cast<int>(i));
    }
    const Influence table(column, shape);
    expected = direct(elsewhere);
    CHECK(error(Eigen::VectorXd::Map(DirectOperator(table).apply(some, on_some), nodes)) < rounding);
}

} // namespace

TEST_CASE("every method of applying the influence matrix gives its direct sums", "[contact][areas]") {
    std::srand(8);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        for (const Index nodes : {2, 3, 17, 64, 243, 509}) {
            INFO(static_cast<int>(kernel) << ", " << nodes << " nodes");
            check_paths({kernel, 0, 1.1 * static_cast<double>(nodes), 0.3}, {nodes});
        }
        for (const Extent shape :
             {Extent{2, 3}, Extent{16, 9}, Extent{7, 70}, Extent{70, 5}, Extent{70, 1}, Extent{1, 12}}) {
            if (kernel == Kernel::strip) continue;
            INFO(static_cast<int>(kernel) << ", " << shape.columns << " x " << shape.rows);
            check_paths({kernel, 0.7}, shape);
        }
    }
}
