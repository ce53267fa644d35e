// The transforms of a build with -DRUGOSA_FFT=kissfft, without the other parts of that build.
#include "domain/numerics/fourier.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rough;

TEST_CASE("products by kissfft are those of the dense matrix") {
    std::srand(5);
    for (const Extent shape : {Extent{2, 1}, Extent{31, 1}, Extent{60, 1}, Extent{6, 5}, Extent{9, 14}}) {
        const Index n = shape.nodes();
        const Eigen::VectorXd column = Eigen::VectorXd::Random(n), p = Eigen::VectorXd::Random(n);
        Eigen::MatrixXd dense(n, n);
        for (Index a = 0; a < n; ++a)
            for (Index b = 0; b < n; ++b)
                dense(a, b) = column[std::abs(a / shape.columns - b / shape.columns) * shape.columns +
                                     std::abs(a % shape.columns - b % shape.columns)];
        const Eigen::VectorXd expected = dense * p;
        const double scale = p.norm() * column.norm();
        const auto difference = [&](auto product) {
            std::copy_n(p.data(), n, product.input());
            const auto* found = product.apply();
            double largest = 0;
            for (Index i = 0; i < n; ++i)
                largest = std::max(largest, std::abs(static_cast<double>(found[i]) - expected[i]));
            return largest / scale;
        };
        CHECK(difference(FourierOperator::toeplitz(column, shape)) < 1e-14);
        CHECK(difference(SingleFourierOperator::toeplitz(column, shape)) < 1e-6);
        CHECK((SplitOperator(column, shape).apply(p) - expected).norm() < 1e-14 * scale);
    }
}

TEST_CASE("transforms by kissfft and their inverses give the numbers again") {
    for (const Extent shape : {Extent{21, 1}, Extent{20, 1}, Extent{12, 7}}) {
        const Eigen::ArrayXXd numbers = Eigen::ArrayXXd::Random(shape.columns, shape.rows);
        const auto n = static_cast<double>(shape.nodes());
        const Eigen::ArrayXXd back = inverse_fourier_transform(fourier_transform(numbers), shape.columns) / n;
        CHECK((back - numbers).abs().maxCoeff() < 1e-14);
    }
}
