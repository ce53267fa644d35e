#include "domain/design/morph.hpp"

#include "domain/errors.hpp"
#include "domain/text/words.hpp"
#include "ga/refinement/levenberg_marquardt.hpp"
#include "ga/refinement/nlopt_search.hpp"

#include <cstdio>
#include <numbers>

namespace rough {
namespace {

constexpr int first_try = 20, second_try = 12; ///< maximum numbers of curves with derivatives
/// A try that has not met the targets ends after this many curves without a better worst misfit. Tries that
/// cannot meet the targets would otherwise take longest.
constexpr int patient_gradients = 6;
constexpr double min_improvement = 0.02; ///< relative, of the worst misfit
/// The second try continues from another point only if its worst misfit is smaller by this share.
constexpr double worth_another_try = 0.01;
/// Share of the allowed misfit that is aimed at, as a step ends near its bounds and not on them.
constexpr double aim = 0.98;
constexpr double min_aim = 1e-6; ///< minimum misfit that is aimed at, by which misfits are divided
/// Cost of misfits above the allowed one over a change of every phase by its range: misfits come first.
constexpr double cost_of_misfit = 100;

/// "1:1 to 1:13, 2:1 to 2:9"
std::string chromosomes_of(const Genome& genome) {
    std::string words;
    for (std::size_t s = 0; s < genome.series.size(); ++s) {
        const auto [first, last] = std::ranges::minmax_element(genome.series[s].chromosomes, {}, &Chromosome::n);
        words += line_of(s ? ", " : "", s + 1, ":", first->n, " to ", s + 1, ":", last->n);
    }
    return words;
}

/// Searches for the smallest change x of the controlled phases whose misfits are `allowed`, or else for the
/// smallest largest misfit. x = 0 are the given phases, -1 and 1 the largest changes.
class LeastChange {
  public:
    LeastChange(const DesignProblem& problem, const Genome& genome, const std::vector<ChromosomeName>& control,
                double radius, double allowed)
        : problem_(problem), genome_(genome), values_(genes(genome)), radius_(radius), allowed_(allowed) {
        const auto controlled = [&](std::size_t s, std::size_t c) {
            return std::count(control.begin(), control.end(),
                              ChromosomeName{s + 1, genome.series[s].chromosomes[c].n}) > 0;
        };
        for (const ga::Variable& phase : phase_variables(genome, {}, controlled)) chosen.push_back(phase.gene);
        look(Eigen::VectorXd::Zero(size()));
    }

    std::vector<std::size_t> chosen; ///< controlled genes
    long gradients = 0;              ///< computed curves with derivatives

    Genome at(const Eigen::VectorXd& x) const {
        std::vector<double> values = values_;
        for (Index i = 0; i < size(); ++i) values[chosen[static_cast<std::size_t>(i)]] += radius_ * x[i];
        return with_genes(genome_, values);
    }
    bool meets() const { return best_.merit > 0; }
    /// Merit of the best point: above 0 if it meets the targets, else minus its worst misfit.
    double merit() const { return best_.merit; }
    const Eigen::VectorXd& best() const { return best_.x; }

    /// Sequential quadratic programming from the best point.
    void nearest(int evaluations) {
        const Eigen::VectorXd from = best_.x;
        const double goal = std::max(aim * allowed_, min_aim);
        const Index n = from.size(), rows = look(from).residuals.size();
        // One more variable t: |r_k| <= (1 + t) goal.
        Eigen::VectorXd lower = Eigen::VectorXd::Constant(n + 1, -1), upper = Eigen::VectorXd::Ones(n + 1),
                        start(n + 1);
        lower[n] = 0;
        upper[n] = std::max(1., look(from).residuals.cwiseAbs().maxCoeff() / goal - 1);
        start << from, upper[n];
        ga::NloptSearch search(nlopt::LD_SLSQP, lower, upper, 10 * evaluations);
        search->set_ftol_rel(1e-4);
        const long last = gradients + evaluations;
        last_better_ = gradients;
        search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
            if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, n + 1) << x.head(n), cost_of_misfit;
            return 0.5 * x.head(n).squaredNorm() + cost_of_misfit * x[n];
        });
        const auto fill = [&](const Eigen::VectorXd& x, double* c, double* gradient) {
            using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            Eigen::Map<Eigen::VectorXd> values(c, 2 * rows);
            values.setZero();
            if (gradients >= (meets() ? last : std::min(last, last_better_ + patient_gradients))) {
                search->force_stop();
                return;
            }
            const ga::Sensitivity& at = look(x.head(n));
            values << at.residuals / goal, -at.residuals / goal;
            values.array() -= 1 + x[n];
            if (!gradient) return;
            Eigen::Map<Rows> slopes(gradient, 2 * rows, n + 1);
            slopes.topLeftCorner(rows, n) = at.jacobian / goal;
            slopes.bottomLeftCorner(rows, n) = -at.jacobian / goal;
            slopes.col(n).setConstant(-1);
        };
        search.constrain(static_cast<unsigned>(2 * rows), fill);
        search.from(start);
    }

    /// Levenberg-Marquardt from 0, which avoids some local optima of the quadratic programming.
    void minimise_misfit(int evaluations) {
        ga::Landscape land;
        land.start = Eigen::VectorXd::Zero(size());
        land.lower = Eigen::VectorXd::Constant(size(), -1);
        land.upper = -land.lower;
        land.sensitivity = [&](const Eigen::VectorXd& x) { return std::optional(look(x)); };
        land.exhausted = [] { return false; };
        ga::lm(evaluations, 5).improve(land);
    }

  private:
    Index size() const { return static_cast<Index>(chosen.size()); }

    /// Misfits at a point and their derivatives in the controlled phases. Repeated calls at one point, for
    /// constraints and then for slopes, compute them once.
    const ga::Sensitivity& look(const Eigen::VectorXd& x) {
        if (!seen_ || x != *seen_) {
            ++gradients;
            const ga::Sensitivity all = problem_.sensitivity(at(x), "similarity");
            rows_ = {all.residuals, Eigen::MatrixXd(radius_ * all.jacobian(Eigen::all, chosen))};
            seen_ = x;
        }
        const double worst = rows_.residuals.cwiseAbs().maxCoeff();
        const double merit = worst <= allowed_ ? 1 / (1 + x.norm()) : -worst;
        if (merit > best_.merit + min_improvement * std::abs(best_.merit)) last_better_ = gradients;
        best_.offer(x, merit);
        return rows_;
    }

    const DesignProblem& problem_;
    const Genome& genome_;
    std::vector<double> values_; ///< given genes
    double radius_;              ///< rad
    double allowed_;
    std::optional<Eigen::VectorXd> seen_; ///< the last point
    ga::Sensitivity rows_;                ///< misfits there
    ga::BestPoint best_;
    long last_better_ = 0; ///< `gradients` at the last marked improvement of the best point
};

std::vector<MissedPoint> missed_points(const DesignSetup& setup, const std::vector<Eigen::VectorXd>& misfits,
                                       double allowed) {
    std::vector<MissedPoint> missed;
    for (std::size_t t = 0; t < misfits.size(); ++t)
        for (Index k = 0; k < misfits[t].size(); ++k)
            if (std::abs(misfits[t][k]) > allowed) missed.push_back({t, setup.targets[t].x[k], misfits[t][k]});
    return missed;
}

/// The smallest change on the set-up's grid, as for morph().
Morphed changed(const DesignSetup& given, const Genome& genome, const std::vector<ChromosomeName>& control,
                double largest_change, double required) {
    DesignSetup setup = given;
    const double radius = 2 * std::numbers::pi * largest_change;
    setup.phases = PhaseReach{0, radius};
    const DesignProblem problem(setup);
    const double allowed = 1 - required;
    LeastChange search(problem, genome, control, radius, allowed);
    const bool met = search.meets();
    if (!search.meets()) search.nearest(first_try);
    if (!search.meets()) {
        const double before = search.merit();
        search.minimise_misfit(second_try);
        if (search.merit() > before + worth_another_try * std::abs(before)) search.nearest(second_try);
    }
    if (!met && search.meets()) search.nearest(second_try); // the first end may be short of the least change
    const Eigen::VectorXd& x = search.best();

    Morphed result;
    result.before = similarity(problem.setup(), genome);
    const Genome found = search.at(x);
    const DesignOutcome outcome = problem.evaluate(found);
    result.genome = folded(problem.final_genome(found, outcome));
    result.after = outcome.similarity;
    result.missed = missed_points(setup, outcome.misfits, allowed);
    result.gradients = search.gradients;
    const auto places = gene_places(genome);
    const auto before = genes(genome), after = genes(search.at(x));
    for (Index i = 0; i < x.size(); ++i) {
        const std::size_t g = search.chosen[static_cast<std::size_t>(i)];
        result.changes.push_back({places[g], genome.series[places[g].series].chromosomes[places[g].chromosome].n,
                                  before[g], after[g], std::abs(x[i]) >= 1 - 1e-6});
    }
    return result;
}

} // namespace

std::vector<ChromosomeName> chromosomes_from(const std::string& text, const Genome& genome) {
    std::vector<ChromosomeName> names;
    for (const std::string& word : listed(text)) {
        const auto expect = [&](bool holds, const std::string& problem) {
            if (!holds) refuse_value("control", word, problem);
        };
        int series = 0, n = 0, end = 0;
        expect(word.find_first_not_of("0123456789:") == std::string::npos &&
                   std::sscanf(word.c_str(), "%6d:%6d%n", &series, &n, &end) == 2 &&
                   word.size() == static_cast<std::size_t>(end),
               " is not a chromosome; use SERIES:CHROMOSOME, e.g. 1:3");
        const ChromosomeName name{static_cast<std::size_t>(series), n};
        expect(series >= 1 && name.series <= genome.series.size() &&
                   std::ranges::count(genome.series[name.series - 1].chromosomes, n, &Chromosome::n) > 0,
               " is not in the genome; use " + chromosomes_of(genome));
        expect(!std::count(names.begin(), names.end(), name), " is named twice; name each chromosome once");
        names.push_back(name);
    }
    if (names.empty()) refuse_value("control", "no chromosome is named; use SERIES:CHROMOSOME, e.g. 1:3");
    return names;
}

Morphed morph(const DesignSetup& setup, const Genome& genome, const std::vector<ChromosomeName>& control,
              double largest_change, double required) {
    if (!(largest_change > 0) || largest_change > 0.5)
        refuse_value("largest-change", largest_change, " is out of range (above 0 to 0.5 of a turn)");
    Morphed first = changed(setup, genome, control, largest_change, required);
    if (!setup.model.grid.is_2d()) return first;
    const auto verify = [&](Morphed& morphed) {
        morphed.verified = verified_answer(as_reported(setup), morphed.genome);
        morphed.missed = missed_points(setup, morphed.verified->largest, 1 - required);
    };
    verify(first);
    const Answer& seen = *first.verified;
    if (!(seen.worst < required)) return first;  // also if it was stopped
    const double error = seen.both - seen.worst; // estimated
    Morphed again = changed(corrected_targets(setup, seen.misfits.front(), seen.misfits.back()), genome, control,
                            largest_change, std::min(required + error, 1 - min_aim));
    again.gradients += first.gradients;
    again.before = first.before;
    verify(again);
    again.after = again.verified->similarity;
    return again.verified->worst > seen.worst ? again : first;
}

SearchResult as_found(const DesignSetup& setup, const Morphed& morphed) {
    SearchResult found;
    found.best = morphed.verified ? *morphed.verified : verified_answer(as_reported(setup), morphed.genome);
    found.alternatives = {found.best};
    found.counters.gradients = morphed.gradients;
    found.counters.requested = morphed.gradients;
    return found;
}

} // namespace rough
