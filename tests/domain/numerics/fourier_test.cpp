#include "domain/contact/kernel.hpp"
#include "domain/contact/solvers/influence.hpp"
#include "domain/numerics/fourier.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

using namespace rough;

TEST_CASE("every path of applying the influence matrix gives its direct sums", "[contact]") {
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
        for (const Index nodes : {2, 3, 17, 64, 243, 509}) {
            INFO(static_cast<int>(kernel) << ", " << nodes << " nodes");
            const Eigen::VectorXd column =
                influence_column(kernel, nodes, 1.1 * static_cast<double>(nodes), 0.3);
            std::srand(7);
            const Eigen::VectorXd p = Eigen::VectorXd::Random(nodes).cwiseAbs();
            Eigen::VectorXd direct(nodes);
            for (Index i = 0; i < nodes; ++i) {
                direct[i] = 0;
                for (Index j = 0; j < nodes; ++j)
                    direct[i] += column[std::abs(i - j)] * p[j];
            }
            const double scale = column.cwiseAbs().sum();
            auto apply = [&](FourierOperator op) {
                std::copy_n(p.data(), nodes, op.input());
                return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(op.apply(), nodes));
            };
            SingleFourierOperator single = SingleFourierOperator::toeplitz(column);
            Eigen::VectorXf::Map(single.input(), nodes) = p.cast<float>();
            CHECK(
                (Eigen::VectorXf::Map(single.apply(), nodes).cast<double>() - direct).cwiseAbs().maxCoeff() <
                5e-6 * direct.cwiseAbs().maxCoeff());
            CHECK((apply(FourierOperator::toeplitz(column)) - direct).cwiseAbs().maxCoeff() < 1e-14 * scale);
            CHECK((SplitOperator(column).apply(p) - direct).cwiseAbs().maxCoeff() < 1e-14 * scale);
            std::vector<int> some;
            Eigen::VectorXd on_some(nodes), elsewhere = Eigen::VectorXd::Zero(nodes);
            for (int i = 0; i < nodes; i += 1 + i % 3) {
                on_some[static_cast<Index>(some.size())] = elsewhere[i] = p[i];
                some.push_back(i);
            }
            std::reverse(some.begin(), some.end()); // in any order
            on_some.head(static_cast<Index>(some.size())).reverseInPlace();
            const Influence table(column);
            CHECK((Eigen::Map<const Eigen::VectorXd>(DirectOperator(table).apply(some, on_some), nodes) -
                   SplitOperator(column).apply(elsewhere))
                      .cwiseAbs()
                      .maxCoeff() < 1e-14 * scale);
            if (kernel == Kernel::periodic)
                CHECK((apply(FourierOperator::circulant(nodes, periodic_spectrum(nodes))) - direct)
                          .cwiseAbs()
                          .maxCoeff() < 1e-14 * scale);
        }
}

TEST_CASE("a fast length is the next even number without a prime factor above five") {
    const auto fast = [](Index number) {
        for (const Index factor : {2, 3, 5})
            while (number % factor == 0)
                number /= factor;
        return number == 1;
    };
    for (Index length = 1; length <= 1100; ++length) {
        Index next = length + length % 2;
        while (!fast(next))
            next += 2;
        CHECK(fast_fourier_length(length) == next);
    }
}

TEST_CASE("on areas, too, every path of applying the influence matrix gives its direct sums", "[contact]") {
    std::srand(8);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic})
        for (const Extent shape :
             {Extent{2, 3}, Extent{16, 9}, Extent{7, 70}, Extent{70, 5}, Extent{70, 1}, Extent{1, 12}}) {
            INFO(static_cast<int>(kernel) << ", " << shape.columns << " x " << shape.rows);
            const Eigen::VectorXd column = area_influence_column(kernel, shape, 0.7);
            const Index nodes = shape.nodes();
            const Eigen::VectorXd p = Eigen::VectorXd::Random(nodes).cwiseAbs();
            Eigen::VectorXd direct = Eigen::VectorXd::Zero(nodes);
            for (Index i = 0; i < nodes; ++i)
                for (Index k = 0; k < nodes; ++k)
                    direct[i] +=
                        p[k] * column[std::abs(i / shape.columns - k / shape.columns) * shape.columns +
                                      std::abs(i % shape.columns - k % shape.columns)];
            const double least = 1e-14 * column.cwiseAbs().sum();
            const auto apply = [&](FourierOperator op) {
                std::copy_n(p.data(), nodes, op.input());
                return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(op.apply(), nodes));
            };
            SingleFourierOperator single = SingleFourierOperator::toeplitz(column, shape);
            Eigen::VectorXf::Map(single.input(), nodes) = p.cast<float>();
            const Eigen::VectorXf rounded = Eigen::VectorXf::Map(single.apply(), nodes);
            CHECK((rounded.cast<double>() - direct).cwiseAbs().maxCoeff() < 1e-6 * column.cwiseAbs().sum());
            CHECK((apply(FourierOperator::toeplitz(column, shape)) - direct).cwiseAbs().maxCoeff() < least);
            CHECK((SplitOperator(column, shape).apply(p) - direct).cwiseAbs().maxCoeff() < least);
            if (kernel == Kernel::periodic)
                CHECK((apply(FourierOperator::circulant(shape, area_spectrum(shape, 0.7))) - direct)
                          .cwiseAbs()
                          .maxCoeff() < least);
            std::vector<int> all(static_cast<std::size_t>(nodes));
            std::iota(all.begin(), all.end(), 0);
            const Influence table(column, shape);
            CHECK((Eigen::Map<const Eigen::VectorXd>(DirectOperator(table).apply(all, p), nodes) - direct)
                      .cwiseAbs()
                      .maxCoeff() < least);
        }
}
