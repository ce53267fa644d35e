#include "domain/design/statistical.hpp"

#include "domain/errors.hpp"
#include "ga/text/adaptation_vocabulary.hpp"
#include "ga/text/parser.hpp"

namespace rough {

namespace {

/// The parameters as real genes: H, ln(long cut-off/L), the short cut-off as a logarithmic share (0 to 1) of
/// its range, and ln(slope).
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
    Eigen::VectorXd predicted(const Genome& genes) const {
        const TheoryCurve curve = predicted_curve(task->theory, random_surface(parameters(genes)),
                                                  task->effective_modulus, task->target.x);
        return is_contact_fraction(task->target.quantity) ? curve.contact_fraction : curve.stiffness;
    }
    double evaluate(const Genome& genes) const { return similarity_of(predicted(genes)); }

    double similarity_of(const Eigen::VectorXd& y) const {
        return y.allFinite() ? similarity(misfit(task->target, y)) : std::nan("");
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
    const Quantity quantity = task.target.quantity;
    if (quantity != Quantity::stiffness && quantity != Quantity::interface_stiffness &&
        quantity != Quantity::area_at_pressure)
        refuse("target: no theory predicts this quantity; use stiffness or contact area against pressure");
    if (task.nodes < 40)
        refuse("nodes: ", task.nodes, " is out of range (at least 40: waves are from L/8 to 8 nodes)");
    if (!holds_for(task.theory, task.is_area))
        refuse("theory: ", name_of(task.theory), " does not hold for profiles; use persson");
}

} // namespace

StatisticalAnswer statistical_design(const StatisticalTask& task, const std::string& pipeline,
                                     std::uint64_t seed, int threads, const std::atomic<bool>* stop) {
    expect_fit(task);
    const StatisticalProblem problem{&task};
    const ga::RunOptions options{.seed = seed, .threads = threads, .budget = {.stop = stop}};
    const auto stage =
        ga::Parser<StatisticalProblem>(ga::with_adaptation(ga::vocabulary<StatisticalProblem>()))
            .parse(pipeline);
    const auto found = ga::run(stage, problem, {}, options);
    if (!found.best)
        refuse("statistical design: no surface has a curve at the target's pressures; lower the pressures");
    const std::vector<double>& genes = found.best->genome;
    return {problem.parameters(genes), problem.predicted(genes), found.best->value(),
            found.counters.evaluations};
}

RealisedAnswer realised_answer(const StatisticalTask& task, const SelfAffine& parameters,
                               std::uint64_t seed) {
    const Grid grid{.nodes = task.nodes,
                    .length = task.length,
                    .periodic = true,
                    .rows = task.is_area ? task.nodes : 1,
                    .width = task.is_area ? task.length : 0};
    RealisedAnswer answer{realised(parameters, grid, seed),
                          Eigen::VectorXd::Constant(task.target.points(), std::nan("")), 0};
    const Body body{.kernel = Kernel::periodic, .effective_modulus = task.effective_modulus};
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
    answer.similarity = StatisticalProblem{&task}.similarity_of(answer.exact);
    return answer;
}

} // namespace rough
