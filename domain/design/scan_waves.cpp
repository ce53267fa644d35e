#include "domain/design/scan_waves.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/problem/response.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rough {

namespace {

/// A node that contact does not see, against 1 for one that it does.
constexpr double unseen = 0.02;
/// Rounds in which nodes that the sum stands above are given their weight.
constexpr int rounds = 4;
/// Of the waves, against the nodes' weights.
constexpr double damping = 1e-4;
/// Of longer scans the highest node of each part is followed: contact is on peaks.
constexpr Index most_points = 2048;

/// What is followed of a scan.
struct Points {
    Eigen::VectorXd x, z; ///< mm
    Eigen::VectorXd weight;
};

Points points_of(const Profile& scan, const std::vector<int>& touching) {
    const Index n = scan.nodes(), part = (n + most_points - 1) / most_points, count = (n + part - 1) / part;
    Points points{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd::Constant(count, unseen)};
    for (Index k = 0; k < count; ++k) {
        Index highest = 0;
        points.z[k] = scan.heights.segment(k * part, std::min(part, n - k * part)).maxCoeff(&highest);
        points.x[k] = scan.spacing * static_cast<double>(k * part + highest);
    }
    for (const int node : touching)
        points.weight[node / part] = 1;
    return points;
}

std::vector<int> touching(const DesignSetup& setup) {
    const Body body = completed(setup.model.body, setup.model.grid.length);
    double last = 0;
    for (const Loading& loading : loadings_of(setup, setup.model.loading).each)
        last = std::max(last, step_displacements(*setup.like, body, loading, setup.model.contact).back());
    ContactOptions contact = setup.model.contact;
    contact.states = true;
    return solve_contact(*setup.like, body, {last}, contact).states.front().nodes;
}

double longest_own(const DesignSetup& setup) {
    return (setup.model.grid.periodic ? 1 : 2) * setup.model.grid.length;
}

} // namespace

Index max_scan_waves(const DesignSetup& given) {
    const DesignSetup setup = completed(given);
    return static_cast<Index>(longest_own(setup) /
                              std::max(setup.limits.shortest_wave, 2 * setup.model.grid.spacing()) *
                              (1 + 1e-12));
}

Genome scan_waves(const DesignSetup& given, Index waves) {
    if (!given.like)
        throw InputError("own: no measured profile given, expected a design like one");
    if (given.like->is_2d())
        throw InputError("own: a map given, expected a profile: the waves are a line's");
    const DesignSetup setup = completed(given);
    const double longest = longest_own(setup);
    const Index count = std::max<Index>(1, waves);
    Points points = points_of(*setup.like, touching(setup));
    Eigen::MatrixXd basis(points.x.size(), 1 + 2 * count);
    basis.col(0).setOnes();
    for (Index k = 1; k <= count; ++k) {
        const Eigen::ArrayXd angle = 2 * std::numbers::pi * static_cast<double>(k) / longest * points.x;
        basis.col(2 * k - 1) = angle.cos();
        basis.col(2 * k) = angle.sin();
    }
    Eigen::VectorXd parts;
    for (int round = 0; round < rounds; ++round) {
        const Eigen::MatrixXd rows = points.weight.cwiseSqrt().asDiagonal() * basis;
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(basis.cols(), basis.cols());
        normal.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
        normal.diagonal().tail(2 * count).array() += damping * points.weight.sum();
        parts = normal.ldlt().solve(basis.transpose() * points.weight.cwiseProduct(points.z));
        const Eigen::ArrayXd above = basis * parts - points.z;
        points.weight = (above > 0).select(1, points.weight);
    }
    Genome genome{1, {}};
    for (Index k = 1; k <= count; ++k) {
        const double c = parts[2 * k - 1], s = parts[2 * k]; // -R cos(q x + theta) = c cos(q x) + s sin(q x)
        Series series{1,
                      std::clamp(1.0, setup.bounds.H_from, setup.bounds.H_to),
                      std::clamp(2.0, setup.bounds.gamma_from, setup.bounds.gamma_to),
                      longest / static_cast<double>(k),
                      {{1, {std::atan2(s, -c)}}}};
        series.A = std::hypot(c, s) / amplitude(series, 1, 1);
        if (series.A > 0)
            genome.series.push_back(std::move(series));
    }
    return genome;
}

} // namespace rough
