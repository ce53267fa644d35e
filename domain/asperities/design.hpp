#pragma once

#include "domain/asperities/caps.hpp"
#include "domain/design/options.hpp"
#include "domain/target/out_of_reach.hpp"
#include "ga/refinement/landscape.hpp"
#include "ga/text/parser.hpp"

namespace rough {

/// Values that a gene may have: from `from` to `to`, in steps if `step` is above 0.
struct GeneRange {
    double from = 0; ///< lowest value, mm
    double to = 0;   ///< highest value, mm
    double step = 0; ///< distance of allowed values, mm; 0: all values from `from` to `to` are allowed

    bool is_free() const { return from < to; } ///< whether there is more than one value
    double nearest(double value) const;        ///< the allowed value nearest to another
};

/// The heights of all caps in the order of their positions, then their radii if these are genes, mm.
using CapGenome = std::vector<double>;

/// The task of a design with caps.
struct CapSetup {
    CapArray array = {};                    ///< positions of the caps
    double effective_modulus = 1;           ///< E*, MPa
    GeneRange heights = {0, 0.12, 0.001};   ///< allowed heights of the summits
    GeneRange radii = {0.526, 0.526, 0};    ///< allowed radii; a single value is the radius of all caps
    CapModel model = CapModel::interacting; ///< contact model of the search
    std::vector<Target> targets = {};       ///< at least one target
    double required_similarity = 0.98;      ///< similarity from which an answer is reported as found
    double nodes = 1 << 20;                 ///< number of nodes of the map in the verification
    bool positions = false; ///< whether the pipeline `default` ends with stages that swap the places of caps
};

/// Whether all targets are areas against pressure. Independent caps are wrong for all other quantities.
inline bool only_areas(const CapSetup& setup) {
    return std::ranges::all_of(setup.targets,
                               [](const Target& target) { return target.quantity == Quantity::area_at_pressure; });
}
Caps caps_of(const CapSetup& setup, const CapGenome& genome); ///< the caps of a genome

/// The value of a target's quantity, in its unit, for caps with a load (N), area (mm^2) and stiffness (N/mm).
double value_of(const CapSetup& setup, Quantity quantity, double load, double area, double stiffness);

/// The values of the caps' curve at a target's points, and their derivatives.
struct CapCurve {
    Eigen::VectorXd values;   ///< value at each point, in the target's unit
    Eigen::MatrixXd by_genes; ///< derivatives d value/dgene, points x genes; empty unless requested
};
/// The curve that is compared with a target. Stiffness is the tangent dP/dDelta, smooth in the heights.
CapCurve curve_of(const CapSetup& setup, const Target& target, const CapGenome& genome, CapModel model,
                  bool with_derivatives = false);

/// The values of independent caps over those of interacting caps at a target's points.
Eigen::ArrayXd interaction_factor(const CapSetup& setup, const Target& target, const CapGenome& genome);
/// The set-up with independent caps if all targets are areas against pressure, otherwise the given set-up.
/// With `like`, targets are multiplied by its interaction_factor(), so that `like` keeps its misfits.
CapSetup with_independent_caps(CapSetup setup, const CapGenome* like = nullptr);

/// The problem of finding the caps that match all targets. Its objectives are `similarity`, the lowest
/// similarity over all targets, and `goal1`, `goal2`, ..., the similarity to one target.
class CapProblem {
  public:
    using Genome = CapGenome;                     ///< heights, and radii if they are genes
    using Outcome = std::vector<Eigen::VectorXd>; ///< weighted misfits, one vector per target

    /// The problem of a set-up. Throws InputError on an invalid array, range or target.
    explicit CapProblem(CapSetup setup);

    /// The misfits of a genome. Throws NotConverged if the contact cannot be solved.
    Outcome evaluate(const Genome& genome) const;
    /// The objectives: `similarity`, then one per target.
    const std::vector<ga::Objective<Outcome>>& objectives() const { return objectives_; }
    /// The ranges of heights and radii.
    const std::vector<ga::Variable>& bounds(const Genome&) const { return bounds_; }
    /// Random caps whose values are on the steps of their ranges. Half of the samples have a group of high
    /// caps and a group of low caps. In the other half, a cap's depth below the top is share * u^power of the
    /// range. u is uniform for each cap; share and power are drawn once per sample.
    Genome sample(ga::Stream& random) const;
    /// Moves each gene with probability `rate`, by one or more steps of its range. If the range has no steps,
    /// the distance is normally distributed.
    bool mutate(Genome& genome, double rate, ga::Stream& random) const;
    /// Misfits at the objective's points, with exact derivatives.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    const CapSetup& setup() const { return setup_; } ///< the set-up that was given
    const GeneRange& range(std::size_t gene) const;  ///< the range of a gene

  private:
    CapSetup setup_;
    std::vector<ga::Objective<Outcome>> objectives_;
    std::vector<ga::Variable> bounds_;
};

/// The named pipelines for caps; `default` restarts until it has the required similarity.
ga::Variants cap_variants(const CapSetup& setup);

/// The solution by boundary elements, and the largest errors of the model.
struct CapVerification {
    std::vector<MeshedCaps> meshed; ///< solutions at the first, middle and last point of the first target
    std::vector<CapState> states;   ///< results of the model under the same loads
    double similarity = std::numeric_limits<double>::quiet_NaN(); ///< similarity at these points
    double area_error = 0;  ///< largest relative error of the model in the total area
    double force_error = 0; ///< largest error of the model in a cap's force, divided by the largest force
    double seconds = 0;     ///< wall time
};

/// A design with caps, and its similarities.
struct CapAnswer {
    CapGenome genome;      ///< genome whose values are on the steps of their ranges
    double similarity = 0; ///< similarity by the model
    /// Smallest difference from earlier answers in the list; 1 for the first. A difference is the rms
    /// difference of the sorted depths, over the height range.
    double difference = 1;
    CapVerification verification = {}; ///< verification; empty for alternatives

    /// The lowest similarity; NaN if boundary elements have not verified it (std::min() returns a first NaN).
    double lowest() const { return std::min(verification.similarity, similarity); }
};

/// The result of a search and its cost.
struct CapSearch : SearchRun {
    CapAnswer best;                      ///< the best answer, verified
    std::vector<CapAnswer> alternatives; ///< different answers, the best first
    /// Genomes on the Pareto front, each with its similarity to each target.
    std::vector<std::pair<CapGenome, std::vector<double>>> front;
    double seconds = 0; ///< wall time without verification
};

/// Runs a pipeline on a design with caps. Verifies by boundary elements the best answer whose genes have allowed values
/// (GeneRange). Throws ga::UsageError on a pipeline that cannot work, NotConverged if no curve could be computed.
CapSearch search(const CapSetup& setup, const SearchOptionsOf<CapProblem>& options = {},
                 std::vector<ga::Observer<CapGenome>> observers = {});

/// The reasons why no caps of the set-up can match a target A(F), each with a bound on the similarity. The
/// area of each cap follows from its force (hertz_area). So the area of all caps is smallest if one cap of
/// the smallest radius carries the whole force. It is largest with the largest radii and equal forces.
std::vector<OutOfReach> out_of_reach(const CapSetup& setup);

/// Largest rms found for independent normal height errors with which 95 % of draws keep |misfit| <= `error`.
struct HeightTolerance {
    double error = 0; ///< limit on the largest |misfit|: 0.02, 0.05 or 0.1
    double rms = 0;   ///< standard deviation, mm; 0 if the misfit is larger even without errors
};
/// The tolerances of a design under its model. All levels use the same `draws` draws.
std::vector<HeightTolerance> height_tolerance(const CapSetup& setup, const CapGenome& genome, std::uint64_t seed = 1,
                                              int draws = 100, int threads = 0);

} // namespace rough
