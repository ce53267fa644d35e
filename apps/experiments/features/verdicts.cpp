#include "apps/experiments/features/run.hpp"
#include "domain/numerics/rank_tests.hpp"
#include "domain/numerics/statistics.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace app {

namespace {

using Eigen::Index;
using nlohmann::json;

const std::array<std::string, 3> levels{"low", "middle", "high"};
constexpr double sure = 0.01;       ///< chance of a difference by chance
constexpr double narrow = 0.67;     ///< answers' quartiles over misses'
constexpr double tolerated = 0.005; ///< loss of similarity: half of what an answer of 0.99 misses

std::vector<double> values_of(const std::vector<FeatureSample>& samples, std::size_t feature) {
    return rough::column(samples, [&](const FeatureSample& one) { return one.features[feature]; });
}

/// Of the answers' quartiles over the misses': the less, the more is shared.
double narrowness(const json& row) {
    return row.at("answers_quartiles").get<double>() / row.at("misses_quartiles").get<double>();
}

Eigen::VectorXd stiffness_of(const std::vector<FeatureSample>& samples, std::size_t k) {
    Eigen::VectorXd values(static_cast<Index>(samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i)
        values[static_cast<Index>(i)] = samples[i].stiffness[k];
    return values;
}

Eigen::MatrixXd columns_of(const std::vector<FeatureSample>& samples,
                           const std::vector<std::size_t>& features) {
    Eigen::MatrixXd columns(static_cast<Index>(samples.size()), static_cast<Index>(features.size()));
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t f = 0; f < features.size(); ++f)
            columns(static_cast<Index>(i), static_cast<Index>(f)) = samples[i].features[features[f]];
    return columns;
}

/// What a law learnt on some rows says of others.
Eigen::VectorXd foretold(const Eigen::MatrixXd& learnt, const Eigen::VectorXd& wanted,
                         const Eigen::MatrixXd& others) {
    constexpr double ridge = 1;
    const Eigen::RowVectorXd mean = learnt.colwise().mean();
    Eigen::RowVectorXd deviation =
        ((learnt.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(learnt.rows())).cwiseSqrt();
    deviation = (deviation.array() > 0).select(deviation, 1);
    const auto standard = [&](const Eigen::MatrixXd& some) -> Eigen::MatrixXd {
        return (some.rowwise() - mean).array().rowwise() / deviation.array();
    };
    const Eigen::MatrixXd x = standard(learnt);
    const Eigen::MatrixXd curvature =
        x.transpose() * x + ridge * Eigen::MatrixXd::Identity(x.cols(), x.cols());
    const Eigen::VectorXd weights =
        curvature.ldlt().solve(x.transpose() * (wanted.array() - wanted.mean()).matrix());
    return (standard(others) * weights).array() + wanted.mean();
}

double rms(const Eigen::ArrayXd& values) { return std::sqrt(values.square().mean()); }

json verdicts_of(const FeatureTarget& target) {
    const auto width = [](const std::vector<double>& values) {
        return rough::quantile(values, 0.75) - rough::quantile(values, 0.25);
    };
    json rows = json::array();
    std::vector<double> ps;
    for (std::size_t f = 0; f < target.features.size(); ++f) {
        const auto answers = values_of(target.answers, f), misses = values_of(target.misses, f);
        ps.push_back(rough::rank_sum_p(answers, misses));
        json row{{"target", target.target.name},
                 {"feature", target.features[f].name},
                 {"meaning", target.features[f].meaning},
                 {"of_shape", target.features[f].of_shape},
                 {"answers_median", rough::median(answers)},
                 {"answers_quartiles", width(answers)},
                 {"misses_median", rough::median(misses)},
                 {"misses_quartiles", width(misses)}};
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::VectorXd stiffness = stiffness_of(target.misses, k);
            row["rank_correlation_" + levels[k]] =
                rank_correlation(misses, {stiffness.begin(), stiffness.end()});
        }
        rows.push_back(std::move(row));
    }
    ps = rough::holm(ps);
    for (std::size_t f = 0; f < ps.size(); ++f) {
        rows[f]["p"] = ps[f];
        rows[f]["kind"] = narrowness(rows[f]) < narrow ? "shared" : ps[f] < sure ? "shifted" : "open";
    }
    return rows;
}

json laws_of(const FeatureTarget& target) {
    std::array<std::pair<std::string, std::vector<std::size_t>>, 3> sets{
        {{"all of shape", {}}, {"those that answers share", {}}, {"waves by octave", {}}}};
    for (std::size_t f = 0; f < target.features.size(); ++f) {
        if (!target.features[f].of_shape)
            continue;
        sets[0].second.push_back(f);
        if (target.verdicts[f]["kind"] == "shared")
            sets[1].second.push_back(f);
        if (target.features[f].name.starts_with("waves"))
            sets[2].second.push_back(f);
    }
    json rows = json::array();
    for (const auto& [name, features] : sets)
        for (std::size_t k = 0; k < 3 && !features.empty(); ++k) {
            const Eigen::MatrixXd columns = columns_of(target.misses, features);
            const Eigen::VectorXd misses = stiffness_of(target.misses, k),
                                  answers = stiffness_of(target.answers, k);
            const Foretold draws = left_out(columns, misses);
            rows.push_back({{"target", target.target.name},
                            {"features", name},
                            {"count", features.size()},
                            {"pressure", levels[k]},
                            {"error", draws.error},
                            {"error_of_mean", draws.of_mean},
                            {"error_on_answers",
                             rms(answers - foretold(columns, misses, columns_of(target.answers, features)))},
                            {"error_of_mean_on_answers", rms(answers.array() - misses.mean())}});
        }
    return rows;
}

} // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> x = rough::ranks(a), y = rough::ranks(b);
    return rough::pearson(Eigen::Map<const Eigen::ArrayXd>(x.data(), static_cast<Index>(x.size())),
                          Eigen::Map<const Eigen::ArrayXd>(y.data(), static_cast<Index>(y.size())));
}

Foretold left_out(const Eigen::MatrixXd& columns, const Eigen::VectorXd& wanted) {
    constexpr Index folds = 5;
    if (wanted.size() < 2 * folds)
        return {};
    Eigen::VectorXd off(wanted.size()), of_mean(wanted.size());
    for (Index fold = 0; fold < folds; ++fold) {
        std::vector<Index> learnt, left;
        for (Index i = 0; i < wanted.size(); ++i)
            (i % folds == fold ? left : learnt).push_back(i);
        const Eigen::VectorXd known = wanted(learnt);
        off(left) = wanted(left) - foretold(columns(learnt, Eigen::all), known, columns(left, Eigen::all));
        of_mean(left) = wanted(left).array() - known.mean();
    }
    return {rms(off), rms(of_mean)};
}

void assess_features(FeatureTarget& target) {
    if (target.answers.empty() || target.misses.empty())
        return;
    target.verdicts = verdicts_of(target);
    target.laws = laws_of(target);
    std::stable_sort(target.verdicts.begin(), target.verdicts.end(),
                     [](const json& a, const json& b) { return narrowness(a) < narrowness(b); });
}

const FeatureSample& FeatureTarget::best() const {
    return *std::max_element(answers.begin(), answers.end(),
                             [](const auto& a, const auto& b) { return a.similarity < b.similarity; });
}

rough::Interval loss_of(const std::vector<double>& all, const std::vector<double>& some) {
    std::vector<double> lost(all);
    for (std::size_t i = 0; i < lost.size(); ++i)
        lost[i] -= some.at(i);
    return rough::median_interval(std::move(lost));
}

bool are_enough(const rough::Interval& loss) { return loss.upper <= tolerated; }

std::string whether_enough(const rough::Interval& loss) {
    if (are_enough(loss))
        return "the waves named are enough";
    return loss.lower > tolerated ? "the waves named are not enough"
                                  : "so few starts do not decide whether the waves named are enough";
}

} // namespace app
