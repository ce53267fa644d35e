#include "apps/experiments/features/run.hpp"
#include "domain/numerics/rank_tests.hpp"
#include "domain/numerics/statistics.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace app {

namespace {

constexpr double sure = 0.01;   ///< chance of a difference by chance
constexpr double narrow = 0.67; ///< answers' quartiles over misses'

std::vector<double> values_of(const std::vector<FeatureSample>& samples, std::size_t feature) {
    return rough::column(samples, [&](const FeatureSample& one) { return one.features[feature].value; });
}

double width(const std::vector<double>& values) {
    return rough::quantile(values, 0.75) - rough::quantile(values, 0.25);
}

Eigen::MatrixXd columns_of(const std::vector<FeatureSample>& samples,
                           const std::vector<std::size_t>& features) {
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(samples.size()),
                            static_cast<Eigen::Index>(features.size()));
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t f = 0; f < features.size(); ++f)
            columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(f)) =
                samples[i].features[features[f]].value;
    return columns;
}

} // namespace

double HeldOut::reached() const {
    return similarity.empty() ? std::numeric_limits<double>::quiet_NaN()
                              : 1 - rough::share_up_to(similarity, std::nextafter(0.99, 0));
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> x = rough::ranks(a), y = rough::ranks(b);
    return rough::pearson(Eigen::Map<const Eigen::ArrayXd>(x.data(), static_cast<Eigen::Index>(x.size())),
                          Eigen::Map<const Eigen::ArrayXd>(y.data(), static_cast<Eigen::Index>(y.size())));
}

double left_out_r2(const Eigen::MatrixXd& columns, const Eigen::VectorXd& wanted) {
    constexpr Eigen::Index folds = 5;
    constexpr double ridge = 1;
    const Eigen::Index rows = columns.rows(), width = columns.cols();
    double missed = 0, spread = 0;
    for (Eigen::Index fold = 0; fold < folds; ++fold) {
        std::vector<Eigen::Index> learnt, left;
        for (Eigen::Index i = 0; i < rows; ++i)
            (i % folds == fold ? left : learnt).push_back(i);
        if (left.empty() || learnt.size() < 2)
            return std::numeric_limits<double>::quiet_NaN();
        const Eigen::MatrixXd own = columns(learnt, Eigen::all);
        const Eigen::RowVectorXd mean = own.colwise().mean();
        const Eigen::RowVectorXd deviation =
            ((own.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(own.rows())).cwiseSqrt();
        const auto standard = [&](const Eigen::MatrixXd& some) {
            Eigen::MatrixXd result = some.rowwise() - mean;
            for (Eigen::Index c = 0; c < width; ++c)
                result.col(c) /= deviation[c] > 0 ? deviation[c] : 1;
            return result;
        };
        const Eigen::MatrixXd x = standard(own);
        const Eigen::VectorXd y = wanted(learnt);
        const Eigen::VectorXd weights = (x.transpose() * x + ridge * Eigen::MatrixXd::Identity(width, width))
                                            .ldlt()
                                            .solve(x.transpose() * (y.array() - y.mean()).matrix());
        const Eigen::VectorXd told = (standard(columns(left, Eigen::all)) * weights).array() + y.mean();
        missed += (wanted(left) - told).squaredNorm();
        spread += (wanted(left).array() - y.mean()).square().sum();
    }
    return 1 - missed / spread;
}

void judge_features(FeatureTarget& target) {
    if (target.answers.empty() || target.misses.empty())
        return;
    std::vector<FeatureSample> all; // alternating, so that each fifth has both
    for (std::size_t i = 0; i < std::max(target.answers.size(), target.misses.size()); ++i) {
        if (i < target.answers.size())
            all.push_back(target.answers[i]);
        if (i < target.misses.size())
            all.push_back(target.misses[i]);
    }
    const auto stiffness = [&](std::size_t k) {
        return rough::column(all, [&](const FeatureSample& one) { return one.stiffness[k]; });
    };
    std::vector<double> ps;
    target.verdicts.clear();
    for (std::size_t f = 0; f < all.front().features.size(); ++f) {
        const SurfaceFeature& feature = all.front().features[f];
        FeatureVerdict verdict{feature.name, feature.meaning, feature.of_shape};
        const auto answers = values_of(target.answers, f), misses = values_of(target.misses, f);
        verdict.answers = rough::median(answers), verdict.answers_width = width(answers);
        verdict.misses = rough::median(misses), verdict.misses_width = width(misses);
        ps.push_back(rough::rank_sum_p(answers, misses));
        for (std::size_t k = 0; k < 3; ++k)
            verdict.rank_correlation[k] = rank_correlation(values_of(all, f), stiffness(k));
        target.verdicts.push_back(std::move(verdict));
    }
    ps = rough::holm(ps);
    for (std::size_t f = 0; f < ps.size(); ++f) {
        FeatureVerdict& verdict = target.verdicts[f];
        verdict.p = ps[f];
        using Kind = FeatureVerdict::Kind;
        verdict.kind = verdict.answers_width < narrow * verdict.misses_width ? Kind::shared
                       : verdict.p < sure                                    ? Kind::shifted
                                                                             : Kind::open;
    }
    std::array<std::vector<std::size_t>, 3> sets;
    for (std::size_t f = 0; f < target.verdicts.size(); ++f) {
        const FeatureVerdict& verdict = target.verdicts[f];
        if (!verdict.of_shape)
            continue;
        sets[0].push_back(f);
        if (verdict.kind == FeatureVerdict::Kind::shared)
            sets[1].push_back(f);
        if (verdict.name.starts_with("waves"))
            sets[2].push_back(f);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<double> wanted = stiffness(k);
        for (std::size_t set = 0; set < sets.size(); ++set)
            target.regression[set][k] = left_out_r2(
                columns_of(all, sets[set]),
                Eigen::Map<const Eigen::VectorXd>(wanted.data(), static_cast<Eigen::Index>(wanted.size())));
    }
}

} // namespace app
