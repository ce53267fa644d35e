#pragma once

#include "apps/experiments/paper/run.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"

/// Measurements for claims that do not depend on a search.
namespace app {

/// Figure 1: chromosome n with random phases, summed ridge by ridge as in Eq. 1. Its series has M = 8,
/// gamma = 1.5, L = lambda_1 = 0.1 mm, H = 0.8 and A = 1e-2.
struct ChromosomeExample {
    int n;
    double wave_length;                  ///< lambda gamma^(1-n), mm
    Eigen::VectorXd x;                   ///< mm
    std::vector<Eigen::VectorXd> ridges; ///< G [cos(phi) - cos(k x + phi)], mm
    Eigen::VectorXd sum;                 ///< mm
    double misfit; ///< largest distance of the sum from the best cosine of that wavelength, over its range
};
ChromosomeExample chromosome_example(int n, std::uint64_t seed);

/// Figure 2: how often the paper's condition (10), |g1| <= sqrt(M + 2 g3), holds for random phases.
struct RidgeCount {
    int ridges;          ///< M >= 2
    double as_printed;   ///< share of phase sets for which it holds as the formula stands, 0..1
    double last_missing; ///< share with the last pair left out of g3 and a negative radicand read as 0
    double right_phase;  ///< share for which Eq. 8's arccos(g1/R) gives the phase of the sum
};
/// For each M, `sets` sets of phases, uniform over a turn.
std::vector<RidgeCount> ridge_study(const std::vector<int>& ridge_counts, int sets, std::uint64_t seed);

/// Figure 3: a profile that is not an MWM series, in octave bands instead of chromosomes. Algorithm 1
/// correlates the K of each band with the whole profile's. The dominant bands make the reduced profile.
struct FractalStudy {
    rough::Profile whole, reduced;
    std::vector<rough::Band> bands;
    std::vector<bool> dominant; ///< correlation > 0.95, or the best one if none passes
    rough::Response whole_response, reduced_response;
};
/// The second reading of Algorithm 1, which is compared with the run's.
inline rough::DominanceReading other(rough::DominanceReading reading) {
    using enum rough::DominanceReading;
    return reading == same_pressure ? same_step : same_pressure;
}

/// The reduction of one genome by Algorithm 1 under one reading of its correlation.
struct Reduction {
    double kept = 0;        ///< share of the chromosomes that are kept, 0..1
    double similarity = 0;  ///< similarity of K(p) of the reduced and the whole profile at p_max (Eq. 12)
    bool only_best = false; ///< no correlation was above 0.95
};
/// Mean relative change of a genome's curves without half of its waves, at pressures that both profiles
/// reach. NaN if the remaining profile is flat.
struct Removal {
    double stiffness = unknown, area = unknown;
};

/// Nodes in contact, summed over the load steps of a database, and the nodes that left contact later.
struct Contacts {
    long nodes = 0, lost = 0;
};

/// The studies of one genome of the database.
struct GenomeStudy {
    Reduction ours = {}, other = {};                ///< under the run's reading of Algorithm 1, and the other
    Removal without_coarse = {}, without_fine = {}; ///< without the longer, the shorter half of the waves
    double datum_similarity = unknown;              ///< similarity of K(p) at the two data
    rough::Curve at_other_datum = {};               ///< K(p) at p_max
    Contacts contacts = {};
};

/// The studies of one run.
struct Studies {
    std::vector<ChromosomeExample> chromosomes = {}; ///< n = 1, 2
    std::vector<RidgeCount> ridges = {};
    std::vector<FractalStudy> fractals = {}; ///< twenty profiles, on the run's grid and body
    std::vector<GenomeStudy> genomes = {};   ///< one per genome of the database
};
constexpr double datum_factor = 4; ///< the second datum over the run's
Studies studies_of(const PaperRun& run);

/// A number of each genome's study.
template <class Part>
std::vector<double> genome_column(const Studies& studies, Part GenomeStudy::*part, double Part::*value) {
    return rough::column(studies.genomes, [&](const GenomeStudy& one) { return one.*part.*value; });
}

/// Mean relative difference |b - a|/a at the points of `a` within the range of `b`; NaN without such points.
double relative_gap(const rough::Curve& a, const rough::Curve& b);
/// Largest difference |b - a| at the points of `a` within the range of `b`; NaN without such points.
double gap(const rough::Curve& a, const rough::Curve& b);

} // namespace app
