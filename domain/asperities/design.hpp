#pragma once

#include "domain/asperities/caps.hpp"
#include "domain/design/options.hpp"
#include "domain/target/out_of_reach.hpp"
#include "ga/problem/problem.hpp"
#include "ga/refinement/sensitivity.hpp"
#include "ga/text/compiled_once.hpp"

namespace rough {

/// Values that a gene may have: from `from` to `to`, in steps if `step` is above 0.
struct GeneRange {
    double from = 0; ///< lowest value, mm
    double to = 0;   ///< highest value, mm
    double step = 0; ///< mm; 0: any value between

    bool is_free() const { return from < to; } ///< whether there is more than one value
    double nearest(double value) const;        ///< the allowed value nearest to another
};

/// Heights of all caps, place by place, then their radii if these are genes, mm.
using CapGenome = std::vector<double>;

/// The task of a design with caps.
struct CapSetup {
    CapArray array = {};                    ///< places of the caps
    double effective_modulus = 1;           ///< E*, MPa
    GeneRange heights = {0, 0.12, 0.001};   ///< heights of the summits
    GeneRange radii = {0.526, 0.526, 0};    ///< one radius if it is not free
    CapModel model = CapModel::interacting; ///< model of the search
    std::vector<Target> targets = {};       ///< at least one
    double required_similarity = 0.98;      ///< from which an answer is called found
    double nodes = 1 << 20;                 ///< nodes of the map of the verification
    bool positions = false;                 ///< the usual pipeline ends by exchanging caps
};

/// The caps of a genome.
Caps caps_of(const CapSetup& setup, const CapGenome& genome);

/// The value of a target's quantity (MPa, mm) of caps under a load (N) with an area (mm^2) and a stiffness
/// (N/mm).
double value_of(const CapSetup& setup, Quantity quantity, double load, double area, double stiffness);

/// Values of a target's curve at its points, and d value/dgene.
struct CapCurve {
    Eigen::VectorXd values;    ///< in the target's unit
    Eigen::MatrixXd by_genes;  ///< points x genes; empty unless requested
    std::vector<double> loads; ///< F at the points, N
};
/// The curve of a target under a model. Stiffness is the tangent dP/dDelta, which for caps is a smooth
/// function of the heights.
CapCurve curve_of(const CapSetup& setup, const Target& target, const CapGenome& genome, CapModel model,
                  bool with_derivatives = false);

/// A genome's misfits to the targets.
struct CapOutcome {
    std::vector<Eigen::VectorXd> misfits; ///< weighted, one vector per target

    double similarity() const; ///< 1 - the largest |misfit| of all targets
};

/// Finds the caps that match all targets. Objectives: `similarity`, the lowest over all targets; `goal1`,
/// `goal2`, ...: on one target.
class CapProblem {
  public:
    using Genome = CapGenome;   ///< heights, and radii if they are genes
    using Outcome = CapOutcome; ///< misfits to the targets

    /// Throws InputError as validate() does.
    explicit CapProblem(CapSetup setup);

    /// The misfits. Throws NotConverged if the contact cannot be solved.
    Outcome evaluate(const Genome& genome) const;
    /// `similarity`, then one per target.
    const std::vector<ga::Objective<Outcome>>& objectives() const { return objectives_; }
    /// The ranges of heights and radii.
    const std::vector<ga::Variable>& bounds(const Genome&) const { return bounds_; }
    /// Random caps with values on the steps. The depths below the highest cap are powers of uniform draws
    /// within a random share of the range. Otherwise there is a group of high caps and a group of low ones.
    Genome sample(ga::Stream& random) const;
    /// Moves each gene with probability `rate`: by one or more steps, or by a normal step without them.
    bool mutate(Genome& genome, double rate, ga::Stream& random) const;
    /// Misfits at the objective's points, with exact derivatives.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    const CapSetup& setup() const { return setup_; } ///< as given
    /// The range of a gene.
    const GeneRange& range(std::size_t gene) const;

  private:
    CapSetup setup_;
    std::vector<ga::Objective<Outcome>> objectives_;
    std::vector<ga::Variable> bounds_;
};

/// Throws InputError on an invalid array, range or target.
void validate(const CapSetup& setup);

/// The engine's operators for caps.
ga::Registry<CapProblem> cap_engine_words();
/// The operators of text pipelines for caps: those of the engine, `round` and `exchange`.
ga::Registry<CapProblem> cap_registry(const CapSetup& setup);
/// The named pipelines for caps; `default` restarts until it has the required similarity.
ga::Variants cap_variants(const CapSetup& setup);

/// The solution by boundary elements, and the largest errors of the model.
struct CapVerification {
    std::vector<MeshedCaps> meshed;   ///< at three points of the first target: first, middle, last
    std::vector<PressedCaps> pressed; ///< result of the model under the same loads
    double similarity = std::numeric_limits<double>::quiet_NaN(); ///< at these points
    double area_error = 0;  ///< relative error of the total area by the model
    double force_error = 0; ///< error of a force by the model, over the largest force
    double seconds = 0;     ///< wall time
};

/// A design with caps, and its similarities.
struct CapAnswer {
    CapGenome genome;                  ///< on the steps of its ranges
    double similarity = 0;             ///< similarity by the model
    double difference = 1;             ///< smallest difference from the answers before it
    CapVerification verification = {}; ///< empty for alternatives

    /// The lowest similarity; NaN if boundary elements have not verified it.
    double lowest() const;
};

/// The result of a search and its cost.
struct CapSearch {
    CapAnswer best;                                               ///< verified
    std::vector<CapAnswer> alternatives;                          ///< the best first
    std::vector<std::pair<CapGenome, std::vector<double>>> front; ///< with similarities to each target
    ga::Counters counters;                                        ///< of the pipeline
    std::vector<std::string> notes;                               ///< remarks of stages
    std::string stopped;  ///< why a stop or a budget ended the pipeline early
    std::string name;     ///< of the variant, or "pipeline"
    std::string pipeline; ///< its text
    double seconds = 0;   ///< wall time without verification
};

/// Runs a pipeline on a design with caps, and verifies its best answer within the ranges by boundary
/// elements. Throws ga::UsageError on a pipeline that cannot work, NotConverged if no curve could be
/// computed.
CapSearch search(const CapSetup& setup, const SearchOptionsOf<CapProblem>& options = {},
                 std::vector<ga::Observer<CapGenome>> observers = {});

/// The area (mm^2) that caps of the set-up can have under a force (N), if each has the area of its force.
struct AreaLimits {
    double min; ///< mm^2
    double max; ///< mm^2
};
/// The limits: one cap of the smallest radius, and all caps alike with the largest radius. The lower limit of
/// independent caps also counts the range of heights, because every cap is within it of the highest one.
AreaLimits area_limits(const CapSetup& setup, double force);

/// Why no caps of the set-up can meet a target A(F), and a bound on the similarity.
std::vector<OutOfReach> out_of_reach(const CapSetup& setup);

/// The rms of independent normal errors of all heights at which 95 % of draws keep the error of the curve.
struct HeightTolerance {
    double error = 0; ///< largest relative misfit that is kept: 0.02, 0.05, 0.1
    double rms = 0;   ///< mm; 0 if the design itself has a larger misfit
};
/// The tolerance of a design under its model, from `draws` common draws.
std::vector<HeightTolerance> height_tolerance(const CapSetup& setup, const CapGenome& genome,
                                              std::uint64_t seed = 1, int draws = 100, int threads = 0);

} // namespace rough

/// @cond
GA_PIPELINES_ELSEWHERE(rough::CapProblem)
/// @endcond
