#include "domain/profile/filter.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace rough {
namespace {

/// A sequence's transform, padded with zeros.
std::vector<std::complex<double>> transformed(const Eigen::VectorXd& values, Index length) {
    AlignedBuffer<double> real(length);
    AlignedBuffer<fftw_complex> bins(length / 2 + 1);
    std::fill(std::copy(values.begin(), values.end(), real.data()), real.data() + length, 0.0);
    fftw_execute_dft_r2c(fourier_plan(length).forward, real.data(), bins.data());
    std::vector<std::complex<double>> result;
    for (Index k = 0; k <= length / 2; ++k)
        result.emplace_back(bins[k][0], bins[k][1]);
    return result;
}

/// sum_t weight_t z_(i+t) for every node i, t = -reach .. reach.
Eigen::VectorXd correlated(const std::vector<std::complex<double>>& heights, const Eigen::VectorXd& weights,
                           Index nodes, Index length) {
    const Index reach = weights.size() / 2;
    const auto bins = transformed(weights.reverse(), length);
    AlignedBuffer<double> real(length);
    AlignedBuffer<fftw_complex> product(length / 2 + 1);
    for (std::size_t k = 0; k < bins.size(); ++k) {
        const std::complex<double> one = heights[k] * bins[k];
        product[static_cast<Index>(k)][0] = one.real(), product[static_cast<Index>(k)][1] = one.imag();
    }
    fftw_execute_dft_c2r(fourier_plan(length).backward, product.data(), real.data());
    return Eigen::Map<const Eigen::VectorXd>(real.data() + reach, nodes) / static_cast<double>(length);
}

} // namespace

Eigen::VectorXd low_passed(const Profile& profile, double cut_off) {
    if (!(cut_off > 0))
        refuse("filter: a cut-off of ", cut_off, " mm, expected one above 0");
    const Index nodes = profile.nodes();
    const Index reach =
        static_cast<Index>(std::min(std::floor(cut_off / profile.spacing), static_cast<double>(nodes - 1)));
    if (reach == 0)
        return profile.heights;
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(2 * reach + 1, -1, 1); // x over reach * spacing
    const double share = static_cast<double>(reach) * profile.spacing / cut_off;
    const Eigen::ArrayXd weight = (-std::pow(M_PI * share, 2) / std::log(2.0) * t.square()).exp();

    // Moments of the weights inside the profile, by running sums over t.
    const auto running = [](const Eigen::ArrayXd& values) {
        Eigen::ArrayXd sums(values.size() + 1);
        sums[0] = 0;
        for (Index i = 0; i < values.size(); ++i)
            sums[i + 1] = sums[i] + values[i];
        return sums;
    };
    const Eigen::ArrayXd s0 = running(weight), s1 = running(weight * t), s2 = running(weight * t.square());
    const Index length = fast_fourier_length(nodes + 2 * reach + 1);
    const double mean = profile.heights.mean();
    const auto heights = transformed(profile.heights.array() - mean, length);
    const Eigen::VectorXd t0 = correlated(heights, weight, nodes, length),
                          t1 = correlated(heights, weight * t, nodes, length);
    Eigen::VectorXd result(nodes);
    for (Index i = 0; i < nodes; ++i) {
        const Index first = std::max<Index>(reach - i, 0), past = std::min(reach + nodes - i, 2 * reach + 1);
        const double m0 = s0[past] - s0[first], m1 = s1[past] - s1[first], m2 = s2[past] - s2[first];
        result[i] = mean + (t0[i] * m2 - t1[i] * m1) / (m0 * m2 - m1 * m1);
    }
    return result;
}

} // namespace rough
