#include "domain/contact/kernel.hpp"
#include "domain/contact/solvers/direct.hpp"
#include "domain/numerics/fourier.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

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
            CHECK((Eigen::Map<const Eigen::VectorXd>(DirectOperator(column).apply(some, on_some), nodes) -
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
