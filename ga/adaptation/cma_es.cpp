#include "ga/adaptation/cma_es.hpp"

#include "ga/base/json.hpp"

#include <Eigen/Eigenvalues>

namespace ga {
namespace {

/// Reflects a value at its bounds until it is between them.
double mirrored(double value, const Variable& v) {
    const double width = v.upper - v.lower;
    if ((value >= v.lower && value <= v.upper) || !std::isfinite(width)) return reflected(value, v);
    return std::clamp(v.lower + std::abs(std::remainder(value - v.lower, 2 * width)), v.lower, v.upper);
}

/// The moving genes divided by the distance between their bounds.
Eigen::VectorXd coordinates(const std::vector<double>& genes, const std::vector<Variable>& moving) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(moving.size()));
    for (std::size_t i = 0; i < moving.size(); ++i)
        x[static_cast<Eigen::Index>(i)] = genes[moving[i].gene] / width(moving[i]);
    return x;
}

} // namespace

CmaConstants::CmaConstants(Eigen::Index variables, std::size_t children)
    : lambda(children), mu(static_cast<Eigen::Index>(children / 2)), weights(static_cast<Eigen::Index>(children)) {
    const auto n = static_cast<double>(variables);
    for (Eigen::Index i = 0; i < weights.size(); ++i) // Eq. 49
        weights[i] = std::log((static_cast<double>(children) + 1) / 2) - std::log(static_cast<double>(i + 1));
    const auto effective = [](const auto& w) { return w.sum() * w.sum() / w.squaredNorm(); };
    auto above = weights.head(mu), below = weights.tail(weights.size() - mu);
    mu_eff = effective(above);
    c_sigma = (mu_eff + 2) / (n + mu_eff + 5);                                                     // Eq. 55
    d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma;              // Eq. 55
    c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);                                             // Eq. 56
    c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);                                                    // Eq. 57
    c_mu = std::min(1 - c_1, 2 * (0.25 + mu_eff + 1 / mu_eff - 2) / ((n + 2) * (n + 2) + mu_eff)); // Eq. 58
    chi = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
    above /= above.sum();
    const double smallest = std::min({1 + c_1 / c_mu,                                          // Eq. 50
                                      1 + 2 * effective(below) / (mu_eff + 2),                 // Eq. 51
                                      (1 - c_1 - c_mu) / (n * c_mu)});                         // Eq. 52
    below *= below.sum() < 0 && std::isfinite(smallest) ? smallest / -below.sum() : 0;         // Eq. 53
    every = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(1 / (10 * n * (c_1 + c_mu)))); // B.2
}

SearchDistribution::SearchDistribution(Eigen::VectorXd middle, double step)
    : mean(std::move(middle)), sigma(step), covariance(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
      path_sigma(Eigen::VectorXd::Zero(mean.size())), path_c(path_sigma), axes(covariance),
      scales(Eigen::VectorXd::Ones(mean.size())) {}

Eigen::VectorXd SearchDistribution::at(const Eigen::VectorXd& z) const {
    return mean + sigma * (axes * scales.cwiseProduct(z));
}

Eigen::VectorXd SearchDistribution::whitened(const Eigen::VectorXd& y) const {
    return axes * (axes.transpose() * y).cwiseQuotient(scales);
}

void SearchDistribution::learn(const CmaConstants& c, const Eigen::MatrixXd& steps, const std::vector<bool>& altered) {
    const Eigen::Index n = mean.size(), used = std::min(steps.cols(), c.weights.size());
    const Eigen::Index parents = std::min(c.mu, used);
    Eigen::VectorXd weights = c.weights.head(used);
    weights.head(parents) /= weights.head(parents).sum();
    for (Eigen::Index i = parents; i < used; ++i)
        if (const auto k = static_cast<std::size_t>(i); k < altered.size() && altered[k]) weights[i] = 0;
    const Eigen::VectorXd step = steps.leftCols(parents) * weights.head(parents); // Eq. 41
    mean += sigma * step;                                                         // Eq. 42
    path_sigma =
        (1 - c.c_sigma) * path_sigma + std::sqrt(c.c_sigma * (2 - c.c_sigma) * c.mu_eff) * whitened(step); // Eq. 43
    ++learnt;
    const double length = path_sigma.norm() / c.chi;
    const double stationary = 1 - std::pow(1 - c.c_sigma, 2 * static_cast<double>(learnt));
    const bool calm = length / std::sqrt(stationary) < 1.4 + 2 / (static_cast<double>(n) + 1);
    path_c = (1 - c.c_c) * path_c;
    if (calm) path_c += std::sqrt(c.c_c * (2 - c.c_c) * c.mu_eff) * step; // Eq. 45
    const double decay = 1 + (calm ? 0 : c.c_1 * c.c_c * (2 - c.c_c)) - c.c_1 - c.c_mu * weights.sum();
    for (Eigen::Index i = parents; i < used; ++i) // Eq. 46
        weights[i] *= static_cast<double>(n) / std::max(whitened(steps.col(i)).squaredNorm(), 1e-300);
    const auto columns = steps.leftCols(used);
    covariance = (decay * covariance + c.c_1 * path_c * path_c.transpose() +
                  c.c_mu * columns * weights.asDiagonal() * columns.transpose())
                     .eval();                                               // Eq. 47
    sigma *= std::exp(std::min(1.0, c.c_sigma / c.d_sigma * (length - 1))); // Eq. 44
    if (learnt - drawn < c.every) return;
    covariance = (0.5 * (covariance + covariance.transpose())).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
    axes = solver.eigenvectors();
    scales = solver.eigenvalues().cwiseMax(1e-40 * solver.eigenvalues().maxCoeff()).cwiseSqrt();
    drawn = learnt;
}

void CmaRecord::note(const std::vector<double>& values, std::size_t lambda) {
    const auto k = static_cast<std::size_t>(1 + std::ceil(0.1 + static_cast<double>(lambda) / 4));
    best.push_back(values.front());
    median.push_back(values[values.size() / 2]);
    equal.push_back(values.size() >= k && values[k - 1] == values.front() ? 1 : 0);
    spent += static_cast<long>(values.size());
}

void CmaRecord::forget(std::size_t window) {
    for (auto* each : {&best, &median, &equal})
        if (each->size() > 2 * window) each->erase(each->begin(), each->end() - static_cast<std::ptrdiff_t>(window));
}

const char* stop_criterion(const SearchDistribution& distribution, const CmaConstants& c, CmaRecord& record,
                           double scale) {
    const auto n = static_cast<double>(distribution.mean.size()), lambda = static_cast<double>(c.lambda);
    const auto last = [](const std::vector<double>& all, double count) {
        return std::vector<double>(
            static_cast<double>(all.size()) > count ? all.end() - static_cast<std::ptrdiff_t>(count) : all.begin(),
            all.end());
    };
    const double few = 10 + std::ceil(30 * n / lambda), many = 120 + std::ceil(30 * n / lambda);
    record.forget(static_cast<std::size_t>(std::max(many, n)));
    const auto generations = static_cast<double>(distribution.learnt);
    const Eigen::VectorXd deviations = distribution.sigma * distribution.covariance.diagonal().cwiseSqrt();
    if (generations >= 100 + 50 * (n + 3) * (n + 3) / std::sqrt(lambda)) return "MaxIter";
    if (generations >= few) {
        const auto recent = last(record.best, few);
        const auto [low, high] = std::minmax_element(recent.begin(), recent.end());
        if (*high - *low < 1e-12) return "TolHistFun";
    }
    const auto equal = last(record.equal, n);
    if (generations >= n && std::accumulate(equal.begin(), equal.end(), 0.0) > n / 3) return "EqualFunVals";
    if (deviations.maxCoeff() < 1e-12 * scale &&
        distribution.sigma * distribution.path_c.cwiseAbs().maxCoeff() < 1e-12 * scale)
        return "TolX";
    if (!(distribution.sigma <= 1e20 * scale * distribution.scales.maxCoeff())) return "TolUpSigma";
    if (static_cast<double>(record.best.size()) >= many) {
        const auto middle = [](std::vector<double> part) {
            std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2), part.end());
            return part[part.size() / 2];
        };
        const auto better = [&](const std::vector<double>& all) {
            const auto window = last(all, many);
            return middle({window.end() - 20, window.end()}) > middle({window.begin(), window.begin() + 20});
        };
        if (!better(record.best) && !better(record.median)) return "Stagnation";
    }
    if (std::pow(distribution.scales.maxCoeff() / distribution.scales.minCoeff(), 2) > 1e14) return "ConditionCov";
    const Eigen::Index axis = distribution.learnt % distribution.mean.size();
    if (distribution.mean ==
        distribution.mean + 0.1 * distribution.sigma * distribution.scales[axis] * distribution.axes.col(axis))
        return "NoEffectAxis";
    if (((distribution.mean + 0.2 * deviations).array() == distribution.mean.array()).any()) return "NoEffectCoord";
    return nullptr;
}

CmaPlan::Run CmaPlan::next(long spent, bool both, Stream& random) {
    if (begun) (now_large ? large : small) += spent;
    if (now_large) last_large = spent;
    begun = true;
    now_large = !both || large <= small;
    if (now_large) return {usual << std::min<std::size_t>(++restarts, 20), 1, 0};
    const double ratio = 0.5 * std::pow(2, static_cast<double>(restarts)), u = random.uniform();
    const double children = static_cast<double>(usual) * std::pow(ratio, u * u);
    return {static_cast<std::size_t>(children), std::pow(10, -2 * random.uniform()), last_large / 2};
}

void CmaEs::begin(const std::vector<double>& genes, std::vector<Variable> moving, State& state) const {
    std::erase_if(moving, [&](const Variable& v) { return !(v.lower < v.upper) || v.gene >= genes.size(); });
    if (moving.empty()) throw UsageError("cma-es: the genome has no gene that may move; give bounds that differ");
    state.moving = std::move(moving);
    state.first = coordinates(genes, state.moving);
    state.run.lambda = state.plan.usual =
        population > 0 ? population : CmaConstants::usual_children(state.first.size());
    state.distribution = SearchDistribution(state.first, sigma);
}

void CmaEs::begin_again(State& state, Stream& random) const {
    if (restarts == "none") {
        state.ended = true;
        return;
    }
    state.run = state.plan.next(state.record.spent, restarts == "bipop", random);
    Eigen::VectorXd mean = state.first;
    for (std::size_t i = 0; i < state.moving.size(); ++i)
        if (const Variable& v = state.moving[i]; std::isfinite(v.upper - v.lower))
            mean[static_cast<Eigen::Index>(i)] = random.uniform(v.lower, v.upper) / width(v);
    state.distribution = SearchDistribution(std::move(mean), sigma * state.run.shrink);
    state.record = {};
}

void to_json(nlohmann::json& j, const CmaEs::State& s) {
    const auto numbers = [](const auto& m) { return std::vector<double>(m.data(), m.data() + m.size()); };
    std::vector<double> moving;
    for (const Variable& v : s.moving) moving.insert(moving.end(), {static_cast<double>(v.gene), v.lower, v.upper});
    const SearchDistribution& c = s.distribution;
    j = {moving,
         numbers(s.first),
         {numbers(c.mean), c.sigma, numbers(c.covariance), numbers(c.path_sigma), numbers(c.path_c), numbers(c.axes),
          numbers(c.scales), c.learnt, c.drawn},
         {s.record.best, s.record.median, s.record.equal, s.record.spent},
         {s.plan.usual, s.plan.restarts, s.plan.large, s.plan.small, s.plan.last_large, s.plan.now_large, s.plan.begun},
         {s.run.lambda, s.run.shrink, s.run.max_evaluations},
         s.children,
         s.ended,
         s.mirrored};
}

void from_json(const nlohmann::json& j, CmaEs::State& s) {
    const auto numbers = [](const nlohmann::json& from, Eigen::Index count) {
        const auto all = from.get<std::vector<double>>();
        expect_fit(all.size() == static_cast<std::size_t>(count) &&
                   std::all_of(all.begin(), all.end(), [](double each) { return std::isfinite(each); }));
        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(all.data(), count));
    };
    const auto moving = j.at(0).get<std::vector<double>>();
    expect_fit(moving.size() % 3 == 0);
    for (std::size_t i = 0; i < moving.size(); i += 3) {
        expect_fit(moving[i] >= (i > 0 ? moving[i - 3] + 1 : 0) && moving[i] < 1e9 && moving[i + 1] < moving[i + 2]);
        s.moving.push_back({static_cast<std::size_t>(moving[i]), moving[i + 1], moving[i + 2]});
    }
    const auto n = static_cast<Eigen::Index>(s.moving.size());
    s.first = numbers(j.at(1), n);
    const auto& c = j.at(2);
    s.distribution.mean = numbers(c.at(0), n);
    s.distribution.sigma = c.at(1);
    s.distribution.covariance = numbers(c.at(2), n * n).reshaped(n, n);
    s.distribution.path_sigma = numbers(c.at(3), n), s.distribution.path_c = numbers(c.at(4), n);
    s.distribution.axes = numbers(c.at(5), n * n).reshaped(n, n);
    s.distribution.scales = numbers(c.at(6), n);
    c.at(7).get_to(s.distribution.learnt), c.at(8).get_to(s.distribution.drawn);
    read_parts(j.at(3), s.record.best, s.record.median, s.record.equal, s.record.spent);
    CmaPlan& p = s.plan;
    read_parts(j.at(4), p.usual, p.restarts, p.large, p.small, p.last_large, p.now_large, p.begun);
    read_parts(j.at(5), s.run.lambda, s.run.shrink, s.run.max_evaluations);
    for (const long count : {p.large, p.small, p.last_large, s.record.spent})
        expect_fit(count >= 0 && count <= 1L << 53);
    constexpr std::size_t max_children = 10'000'000;
    expect_fit(s.moving.empty() || (s.run.lambda >= 2 && s.plan.usual >= 2 && s.distribution.sigma > 0 &&
                                    s.run.lambda <= max_children && s.plan.usual <= max_children));
    j.at(6).get_to(s.children);
    s.ended = j.at(7);
    j.at(8).get_to(s.mirrored);
    expect_fit(s.mirrored.size() == s.children.size());
}

void CmaEs::learn(const std::vector<Child>& scored, const CmaConstants& constants, State& state) {
    const auto n = static_cast<double>(state.first.size());
    Eigen::MatrixXd steps(state.first.size(), static_cast<Eigen::Index>(scored.size()));
    std::vector<double> values;
    std::vector<bool> altered;
    for (const Child& child : scored) {
        Eigen::VectorXd step =
            (coordinates(child.genes, state.moving) - state.distribution.mean) / state.distribution.sigma;
        if (child.refined)
            step *= std::min(1.0, (std::sqrt(n) + 2 * n / (n + 2)) / state.distribution.whitened(step).norm());
        steps.col(static_cast<Eigen::Index>(values.size())) = step;
        altered.push_back(child.mirrored);
        values.push_back(child.value);
    }
    if (values.empty()) return;
    state.distribution.learn(constants, steps, altered);
    state.record.note(values, state.run.lambda);
}

void CmaEs::draw(std::size_t k, Stream stream, std::vector<double>& genes, State& state) {
    Eigen::VectorXd z(state.first.size());
    for (double& each : z) each = stream.normal();
    const Eigen::VectorXd x = state.distribution.at(z);
    for (std::size_t i = 0; i < state.moving.size(); ++i) {
        const Variable& v = state.moving[i];
        const double drawn = x[static_cast<Eigen::Index>(i)] * width(v);
        if (drawn < v.lower || drawn > v.upper) state.mirrored[k] = true;
        if (v.gene < genes.size()) genes[v.gene] = mirrored(drawn, v);
    }
}

} // namespace ga
