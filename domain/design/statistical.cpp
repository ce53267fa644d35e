#include "domain/design/statistical.hpp"

#include "domain/contact/solve.hpp"
#include "domain/errors.hpp"
#include "domain/target/similarity.hpp"
#include "ga/pipeline/run.hpp"
#include "ga/text/adaptation_vocabulary.hpp"
#include "ga/text/parser.hpp"

#include <cmath>
#include <limits>

namespace rough {

namespace {

/// The parameters as real genes: H, ln of the long cut-off over L, where the short one lies between its
/// limits (in ln), ln of the slope.
struct StatisticalProblem {
    using Genome = std::vector<double>;
    using Outcome = double; // similarity

    const StatisticalTask* task;
    std::vector<ga::Objective<double>> list = {{"similarity", [](const double& value) { return value; }}};
    std::vector<ga::Variable> box = {
        {0, 0.3, 0.95}, {1, -std::log(8), -std::log(2)}, {2, 0, 1}, {3, std::log(1e-3), 0}};

    SelfAffine parameters(const Genome& genes) const {
        const double longest = task->length * std::exp(genes[1]),
                     shortest = 8 * task->length / static_cast<double>(task->nodes);
        return {.hurst = genes[0],
                .longest = longest,
                .shortest = shortest * std::pow(longest / 2 / shortest, genes[2]),
                .rms_slope = std::exp(genes[3]),
                .is_area = task->is_area};
    }
    Eigen::VectorXd foretold(const Genome& genes) const {
        const TheoryCurve curve = predicted_curve(task->theory, random_surface(parameters(genes)),
                                                  task->effective_modulus, task->target.x);
        return is_contact_fraction(task->target.quantity) ? curve.contact_fraction : curve.stiffness;
    }
    double evaluate(const Genome& genes) const { return likeness(foretold(genes)); }

    double likeness(const Eigen::VectorXd& y) const {
        double worst = 0;
        for (Index k = 0; k < y.size(); ++k)
            worst = std::isnan(y[k]) ? y[k] : std::max(worst, std::abs(misfit(task->target, k, y[k])));
        return y.allFinite() ? 1 - worst : std::numeric_limits<double>::quiet_NaN();
    }
    const std::vector<ga::Objective<double>>& objectives() const { return list; }
    const std::vector<ga::Variable>& bounds(const Genome&) const { return box; }
    Genome sample(ga::Stream& stream) const {
        Genome genes;
        for (const ga::Variable& gene : box)
            genes.push_back(stream.uniform(gene.lower, gene.upper));
        return genes;
    }
};

void expect_fit(const StatisticalTask& task) {
    const Quantity asked = task.target.quantity;
    if (asked != Quantity::stiffness && asked != Quantity::interface_stiffness &&
        asked != Quantity::area_at_pressure)
        refuse("target: expected a stiffness or an area against pressure, which theories foretell");
    if (task.nodes < 40)
        refuse("nodes: ", task.nodes, " given, expected at least 40: waves from L/8 to 8 nodes");
    if (!holds_for(task.theory, task.is_area))
        refuse("theory: ", name_of(task.theory), " given for profiles, expected persson");
}

} // namespace

StatisticalAnswer statistical_design(const StatisticalTask& task, const std::string& pipeline,
                                     std::uint64_t seed, int threads, const std::atomic<bool>* stop) {
    expect_fit(task);
    const StatisticalProblem problem{&task};
    ga::RunOptions options;
    options.seed = seed;
    options.threads = threads;
    options.budget.stop = stop;
    const auto stage =
        ga::Parser<StatisticalProblem>(ga::with_adaptation(ga::vocabulary<StatisticalProblem>()))
            .parse(pipeline);
    const auto found = ga::run(stage, problem, {}, options);
    if (!found.best)
        refuse("statistical design: no surface of these parameters has a curve at the target's pressures");
    const std::vector<double>& genes = found.best->genome;
    return {problem.parameters(genes), problem.foretold(genes), found.best->value(),
            found.counters.evaluations};
}

RealisedAnswer realised_answer(const StatisticalTask& task, const SelfAffine& parameters,
                               std::uint64_t seed) {
    Grid grid{.nodes = task.nodes, .length = task.length, .periodic = true};
    if (task.is_area) {
        grid.rows = task.nodes;
        grid.width = task.length;
    }
    RealisedAnswer answer{realised(parameters, grid, seed),
                          Eigen::VectorXd::Constant(task.target.points(), std::nan("")), 0};
    Body body;
    body.kernel = Kernel::periodic;
    body.effective_modulus = task.effective_modulus;
    std::vector<double> pressures(task.target.x.begin(), task.target.x.end());
    ContactCurve curve;
    for (; !pressures.empty() && curve.steps.empty(); pressures.pop_back()) // up to full contact
        try {
            curve = solve_contact_at_pressures(answer.surface, body, pressures);
        } catch (const InputError&) {
        }
    for (std::size_t k = 0; k < curve.steps.size(); ++k)
        answer.exact[static_cast<Index>(k)] = is_contact_fraction(task.target.quantity)
                                                  ? curve.steps[k].contact_fraction
                                                  : curve.steps[k].tangent_stiffness;
    answer.similarity = StatisticalProblem{&task}.likeness(answer.exact);
    return answer;
}

} // namespace rough
